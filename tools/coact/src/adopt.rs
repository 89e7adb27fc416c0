//! `coact adopt`: a successor for a supervisor that has died.

use crate::installation::Installation;
use crate::{launch, living_runs};
use anyhow::{Context, Result};
use coact_joint_task::NetworkPlan;
use coact_pipeline::{Pipeline, Run};
use coact_supervisor::{Injection, Launch, StopRequest};
use std::process::ExitCode;

/// Takes over a run whose supervisor has died: its processes live on for as long as adoptable_for_s in the process table says.
/// They are watched and replaced again, the run ends as it would have, and its report is the same.
///
/// The robot stands, for nobody knows whether an operator had stopped it, until coact resume or, with --resume, at once.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact adopt                    the run whose supervisor has died; then: coact resume
  coact adopt 1a2b-0 --resume    this one, and its robot goes on at once

Exit status: 0 the work was done (with --strict: in time, too), 1 it was not, 2 nothing was adopted.")]
pub struct Args {
    /// Which run, when there are several
    #[arg(value_name = "RUN")]
    run: Option<String>,
    /// Let the robot go on at once
    #[arg(long)]
    resume: bool,
    /// A fault, as in fields:kill@20s, counted from the beginning of the run; may be repeated
    #[arg(long, value_name = "PROCESS:FAULT@TIME")]
    inject: Vec<Injection>,
    /// Fail also when the timing was not what it should be
    #[arg(long)]
    strict: bool,
    /// Print nothing but the final summary.json on standard output
    #[arg(long)]
    json: bool,
}

/// Supervises the run to its end.
///
/// # Errors
/// There is no such run, or it has a supervisor; a file of it is missing or malformed.
pub fn run(args: Args) -> Result<ExitCode> {
    let run = living_runs::orphaned(args.run.as_deref())?;
    let wanted = if args.resume { StopRequest::Resume } else { StopRequest::Stop };
    let launch = prepare(&run, args.inject).with_context(|| format!("run {}", run.id()))?;
    let settings = launch.settings.clone();
    launch::report(launch.adopt(&run, wanted), &settings, args.json, args.strict)
}

/// What was launched, as the run's directory says.
fn prepare(run: &Run, injections: Vec<Injection>) -> Result<Launch> {
    let settings = run.settings().clone();
    let (task, _) = NetworkPlan::load(&settings.task)?;
    let pipeline = Pipeline::of_run(&settings)?;
    Ok(Launch { settings, pipeline, task, programs: Installation::programs()?, injections })
}
