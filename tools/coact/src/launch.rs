use crate::installation::Installation;
use crate::report_folder::unused_report_folder;
use crate::{closed_pipe, console, lockstep, partner, run_report, snapshots};
use anyhow::{Result, ensure};
use coact_joint_task::NetworkPlan;
use coact_perception::PreshapeModel;
use coact_pipeline::{Layout, Pipeline, RunSettings, WorldMode};
use coact_robot::Robot;
use coact_run_records::{NextRound, Record, Snapshot};
use coact_safety::SafetyLimits;
use coact_supervisor::{Ending, Injection, Launch, LaunchError};
use coact_world::{Partner, Settings, laid_out};
use std::path::{Path, PathBuf, absolute};
use std::process::ExitCode;
use std::time::Duration;

/// The processes that record a run and that show it in a browser, which are started only on request.
const RECORDER: &str = "recorder";
const CONSOLE: &str = "console";
/// How long a run lasts whose partner sits at the console: until it is ended there or here, but not for ever.
const SITTING: Duration = Duration::from_secs(3600);

/// Starts the processes of the pipeline, shows their progress, and reports how fast, punctual and anticipatory they
/// were.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact launch                                        the toy vehicle, with a simulated partner
  coact launch --duration 600 --report reports/long   ten minutes, one assembly after another
  coact launch --inject fields:kill@20s               what if fields is killed after 20 s?
  coact launch --partner recorded                     hands of real people; recorded:DIR for others
  coact launch --partner right-arm:FILE               an arm of motion capture, that takes no part
  coact launch --record --report reports/long         all that was seen and decided, in run.mcap
  coact launch --partner hand                         a hand from outside; see coact hand --help
  coact launch --console                              build with the robot yourself, in a browser
  coact launch --console --partner random             watch there how a simulated person does
  coact launch --layout random:7                      parts elsewhere; the same places each time
  coact launch --lockstep --world kinematic --json    as fast as the machine can

Exit status: 0 the work was done (with --strict: in time, too), 1 it was not, 2 bad usage or configuration.")]
pub struct Args {
    /// The task [default: the toy vehicle]
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// Who works with the robot: synthetic, active, random[:KEY=VALUE,...], script:FILE, recorded,
    /// recorded:DIR, recorded:FILE.mcap (the hand of a run that was recorded), left-arm:FILE, right-arm:FILE, or hand: a hand that comes from outside (coact hand)
    /// [default: synthetic; with --console: hand]
    #[arg(long)]
    partner: Option<String>,
    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Seconds; without it, until all subgoals are achieved, 300 s at most; at the console an hour
    #[arg(long, value_name = "S", value_parser = seconds)]
    duration: Option<Duration>,
    /// Where the report goes [default: reports/DATE-TIME]
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// All stages in one process, as fast as possible, with the same decisions
    #[arg(long, conflicts_with = "inject")]
    lockstep: bool,
    /// How the world computes: physics, or kinematic (same sensors and truth, no contact forces)
    #[arg(long, default_value = "physics")]
    world: WorldMode,
    /// Where the parts lie at the start: task (as it has them), random:SEED (anywhere in the workspace in which the task has
    /// them, 6 cm apart), or random, which takes the seed of --seed
    #[arg(long, value_name = "task|random[:SEED]", default_value = "task")]
    layout: String,
    /// A fault, as in fields:kill@20s; may be repeated (coact inject --help lists them)
    #[arg(long, value_name = "PROCESS:FAULT@TIME")]
    inject: Vec<Injection>,
    /// The process table [default: rt-config/pipeline.toml]
    #[arg(long, value_name = "FILE")]
    pipeline: Option<PathBuf>,
    /// The limits that keep the person safe [default: rt-config/safety.toml]
    #[arg(long, value_name = "FILE")]
    safety: Option<PathBuf>,
    /// How simulated people show grips and gestures [default: rt-config/person.toml]
    #[arg(long, value_name = "FILE")]
    person: Option<PathBuf>,
    /// Record the run: run.mcap in the report's folder, for Foxglove and coact replay
    #[arg(long, conflicts_with = "lockstep")]
    record: bool,
    /// Show the run in a browser, and let whoever sits there be the partner; it is recorded as well
    #[arg(long, conflicts_with = "lockstep")]
    console: bool,
    /// Fail also when the timing was not what it should be
    #[arg(long)]
    strict: bool,
    /// Print nothing but the final summary.json on standard output
    #[arg(long)]
    json: bool,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let expected = || "expected seconds, above 0, for example 90 or 2.5".to_owned();
    let seconds: f64 = text.parse().map_err(|_| expected())?;
    let duration = Duration::try_from_secs_f64(seconds).map_err(|_| expected())?;
    if duration.is_zero() { Err(expected()) } else { Ok(duration) }
}

/// Runs the process set to its end.
///
/// # Errors
/// A file is missing or malformed, or the machine refuses the run: nothing was started, or it was stopped again.
pub fn run(args: Args) -> Result<ExitCode> {
    let (json, strict, in_lockstep) = (args.json, args.strict, args.lockstep);
    let mut launch = prepare(args)?;
    if in_lockstep {
        lockstep::run(&launch)?;
        return show(&launch.settings, json, strict);
    }
    loop {
        let settings = launch.settings.clone();
        let code = report(launch.run(), &settings, json, strict)?;
        match next_round(settings)? {
            Some(next) => launch = next,
            None => return Ok(code),
        }
    }
}

/// The run that somebody at the console wants after this one, if anybody does: of the task and the layout that were chosen, with all else as before.
fn next_round(before: RunSettings) -> Result<Option<Launch>> {
    let Some(next) = NextRound::take(&before.report)? else { return Ok(None) };
    let report = unused_report_folder(before.report.parent().unwrap_or(Path::new("reports")));
    let settings = RunSettings { task: next.task.clone(), layout: next.layout, report, ..before };
    std::fs::create_dir_all(&settings.report)?;
    next.leave(&settings.report)?;
    let (task, _) = NetworkPlan::load(&settings.task)?;
    laid_out(&task, settings.layout)?;
    let (pipeline, programs) = (Pipeline::of_run(&settings)?, Installation::programs()?);
    Ok(Some(Launch { pipeline, settings, task, programs, injections: Vec::new() }))
}

/// Shows how a set of processes has ended.
///
/// # Errors
/// It was refused.
pub(crate) fn report(
    ended: Result<Ending, LaunchError>,
    settings: &RunSettings,
    json: bool,
    strict: bool,
) -> Result<ExitCode> {
    match ended {
        Ok(_) => show(settings, json, strict),
        Err(error) => gave_up(error, settings, json),
    }
}

fn show(settings: &RunSettings, json: bool, strict: bool) -> Result<ExitCode> {
    draw_snapshots(settings);
    closed_pipe::ends_the_program();
    run_report::show(&settings.report, json, strict)
}

/// Reads and checks every file before anything is started.
fn prepare(args: Args) -> Result<Launch> {
    let whoever = if args.console { Partner::HAND } else { "synthetic" };
    let partner = args.partner.unwrap_or_else(|| whoever.to_owned());
    ensure!(
        !args.lockstep || partner != Partner::HAND,
        "--lockstep with --partner hand: nobody can move a hand as fast as the machine can; expected one of the two"
    );
    let Installation { programs, configuration, reaches } = Installation::find()?;
    let shipped = RunSettings::shipped(&configuration);
    let requested = [(args.record || args.console, RECORDER), (args.console, CONSOLE)];
    let requested = requested.iter().filter(|(wanted, _)| *wanted).map(|(_, process)| (*process).to_owned());
    let sits = args.console && partner == Partner::HAND;
    if args.console {
        console::program()?;
    }
    let layout = Layout::parse(&args.layout, args.seed).map_err(anyhow::Error::msg)?;
    ensure!(
        layout == Layout::Task || !partner.starts_with("script:"),
        "--layout {layout} with --partner {partner}: a script arranges its scene itself; expected one of the two"
    );
    let settings = RunSettings {
        task: absolute(args.task.unwrap_or(shipped.task))?,
        pipeline: absolute(args.pipeline.unwrap_or(shipped.pipeline))?,
        safety: absolute(args.safety.unwrap_or(shipped.safety))?,
        person: absolute(args.person.unwrap_or(shipped.person))?,
        report: absolute(args.report.unwrap_or_else(|| unused_report_folder(Path::new("reports"))))?,
        seed: args.seed,
        partner: partner::setting(&partner, &reaches),
        layout,
        world: args.world,
        duration: args.duration.or(sits.then_some(SITTING)),
        requested: requested.collect(),
        ..shipped
    };
    let (task, _) = NetworkPlan::load(&settings.task)?;
    laid_out(&task, settings.layout)?;
    Robot::load(&settings.robot)?;
    let limits = SafetyLimits::load(&settings.safety)?;
    PreshapeModel::load(&settings.model)?;
    Settings::of_run(&settings, &task, limits.drive)?;
    Ok(Launch { pipeline: Pipeline::of_run(&settings)?, settings, task, programs, injections: args.inject })
}

/// The run has its verdict without them: snapshots that cannot be drawn cost a warning only.
fn draw_snapshots(settings: &RunSettings) {
    if let Err(error) = snapshots::draw(&settings.report, &settings.task, &settings.robot) {
        run_report::warn(&format!("the snapshots were not drawn: {error:#}"));
    }
}

/// A process set that was given up has a report as far as it came, and counts as failed; all else was refused.
fn gave_up(error: LaunchError, settings: &RunSettings, json: bool) -> Result<ExitCode> {
    if error.is_configuration() {
        return Err(error.into());
    }
    if settings.report.join(Snapshot::FILE).is_file() {
        draw_snapshots(settings);
    }
    // It may have been given up before there was a summary: the error below says why.
    run_report::show(&settings.report, json, false).ok();
    run_report::warn(&error.to_string());
    Ok(ExitCode::FAILURE)
}
