//! `coact stop` and `coact resume`: the operator's stop of a running process set.

use crate::living_runs;
use anyhow::{Context, Result};
use coact_supervisor::{StopRequest, request_stop};
use std::process::ExitCode;

/// Which run.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Which run, when there are several
    #[arg(long, value_name = "ID")]
    run: Option<String>,
}

/// Stops the robot. The stop belongs to the set, not to this terminal: it outlasts whatever ends or dies, except the set itself.
///
/// # Errors
/// There is no such run, or it cannot be reached.
pub fn stop(args: &Args) -> Result<ExitCode> {
    request(args, StopRequest::Stop, "stopped; coact resume lets the robot go on")
}

/// Lets it go on.
///
/// # Errors
/// As [`stop`].
pub fn resume(args: &Args) -> Result<ExitCode> {
    request(args, StopRequest::Resume, "the robot may go on")
}

/// A stopped robot that is to be stopped is no error, nor is one that may go on already: it is said.
fn request(args: &Args, wanted: StopRequest, done: &str) -> Result<ExitCode> {
    let run = living_runs::only(args.run.as_deref())?;
    let unchanged = request_stop(&run, wanted).with_context(|| format!("run {}", run.id()))?;
    eprintln!("run {}: {}", run.id(), unchanged.as_deref().unwrap_or(done));
    Ok(ExitCode::SUCCESS)
}
