//! `coact snapshots`: a run in pictures.

use crate::closed_pipe;
use crate::installation::Installation;
use anyhow::{Context, Result};
use coact_drawing::Lettering;
use coact_joint_task::Task;
use coact_pictures::ContactSheet;
use coact_robot::Robot;
use coact_run_records::{RunLog, Snapshot};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Draws a run's snapshots once more: who took which part and what came into its place, in up to 24 pictures.
///
/// `coact launch` draws them after every run, from snapshots.jsonl in the report, into plots/assembly.png.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact snapshots reports/2026-11-22T13-16-12Z
  coact snapshots reports/box --task rt-config/tasks/electronics-box.toml")]
pub struct Args {
    /// Report directory of a run
    #[arg(value_name = "REPORT")]
    report: PathBuf,
    /// The run's task [default: the toy vehicle]
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// The run's robot [default: ARoS]
    #[arg(long, value_name = "FILE")]
    robot: Option<PathBuf>,
}

/// Draws the sheet and names it.
///
/// # Errors
/// There is no snapshot log, it is of another task, or the picture cannot be written.
pub fn run(args: Args) -> Result<ExitCode> {
    closed_pipe::ends_the_program();
    let Installation { configuration, .. } = Installation::find()?;
    let task = args.task.unwrap_or_else(|| configuration.join("tasks/toy-vehicle.toml"));
    let robot = args.robot.unwrap_or_else(|| configuration.join("robots/aros.toml"));
    println!("{}", draw(&args.report, &task, &robot)?.display());
    Ok(ExitCode::SUCCESS)
}

/// Where the sheet is in a report.
pub fn sheet(report: &Path) -> PathBuf {
    report.join("plots/assembly.png")
}

/// Draws the snapshots of a report, of a run with the task and the robot of these files; where the sheet is.
///
/// # Errors
/// As [`run`].
pub fn draw(report: &Path, task: &Path, robot: &Path) -> Result<PathBuf> {
    let (task, robot) = (Task::load(task)?, Robot::load(robot)?);
    let snapshots = RunLog::<Snapshot>::read(report)
        .with_context(|| format!("{}: expected the report directory of a run", report.display()))?;
    let letters = Lettering::new()?;
    let picture =
        ContactSheet { snapshots: &snapshots, task: &task, robot: &robot }.draw(&letters)?.png(&letters)?;
    let file = sheet(report);
    std::fs::create_dir_all(report.join("plots"))
        .and_then(|()| std::fs::write(&file, picture))
        .with_context(|| format!("{}: cannot be written", file.display()))?;
    Ok(file)
}
