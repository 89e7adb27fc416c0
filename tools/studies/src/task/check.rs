//! `coact task check`: what is wrong with a task that can be read.

use anyhow::Result;
use coact::installation::Installation;
use coact_control::{Control, ControlError};
use coact_joint_task::{Finding, FindingKind, Task, check};
use coact_person::Habits;
use coact_pipeline::WorldMode;
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_world::{Partner, Settings, World, WorldError};
use owo_colors::{OwoColorize, Stream};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `coact task check`.
#[derive(clap::Args)]
#[command(after_help = "Example:
  coact task check rt-config/tasks/toy-vehicle.toml

Exit status: 0 nothing is wrong, 1 something is, 2 the file cannot be read as a task.")]
pub struct Args {
    /// The task file
    file: PathBuf,
    /// Whose reach is checked [default: rt-config/robots/aros.toml]
    #[arg(long, value_name = "FILE")]
    robot: Option<PathBuf>,
    /// Print one JSON list instead of text
    #[arg(long)]
    json: bool,
}

/// Prints what is wrong.
///
/// # Errors
/// A task, network or robot file that cannot be read as one.
pub fn run(args: Args) -> Result<ExitCode> {
    let configuration = Installation::find()?.configuration;
    let robot = args.robot.unwrap_or_else(|| configuration.join("robots/aros.toml"));
    let limits = SafetyLimits::load(&configuration.join("safety.toml"))?;
    let (task, robot) = (Task::load(&args.file)?, Robot::load(&robot)?);
    let mut findings = check(&args.file)?;
    let habits = Habits::load(&configuration.join("person.toml"), &task)?;
    findings.extend(scene(&args.file, &task, &robot, (&limits, habits))?);
    findings.extend(reach(&args.file, &task, robot, &limits)?);
    if args.json {
        println!("{}", serde_json::to_string_pretty(&findings)?);
    } else {
        findings.iter().for_each(print);
        match findings.len() {
            0 => println!("{}: nothing is wrong", args.file.display()),
            1 => println!("1 finding"),
            count => println!("{count} findings"),
        }
    }
    Ok(if findings.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Whether the simulated world can begin with the scene.
fn scene(
    file: &Path,
    task: &Task,
    robot: &Robot,
    (limits, habits): (&SafetyLimits, Habits),
) -> Result<Option<Finding>> {
    let partner = Partner::load("synthetic", task, 1)?;
    let settings = Settings {
        seed: 1,
        partner,
        habits,
        reaches: None,
        ways: None,
        mode: WorldMode::Physics,
        drive: limits.drive,
    };
    match World::new(task, robot, settings) {
        Ok(_) => Ok(None),
        Err(error @ WorldError::Scene { .. }) => Ok(Some(Finding {
            kind: FindingKind::Scene,
            place: file.display().to_string(),
            what: error.to_string(),
            why: "bodies that start inside each other are thrown apart".into(),
            advice: "move the part, or make it smaller".into(),
        })),
        Err(error) => Err(error.into()),
    }
}

/// Whether the robot can reach every place that it needs.
fn reach(file: &Path, task: &Task, robot: Robot, limits: &SafetyLimits) -> Result<Option<Finding>> {
    match Control::new(robot, task, limits) {
        Ok(_) => Ok(None),
        Err(error @ ControlError::Unreachable { .. }) => Ok(Some(Finding {
            kind: FindingKind::OutOfReach,
            place: file.display().to_string(),
            what: error.to_string(),
            why: "the robot would decide on the action and could not carry it out".into(),
            advice: "move the place nearer to the robot, or let it be the person's side".into(),
        })),
        #[allow(unreachable_patterns, reason = "there may be other errors one day")]
        Err(error) => Err(error.into()),
    }
}

fn print(finding: &Finding) {
    let Finding { kind, place, what, why, advice } = finding;
    let name = kind.name();
    println!("{place}: {}: {what}", name.if_supports_color(Stream::Stdout, |text| text.yellow()));
    println!("    why it matters: {why}");
    println!("    what to do:     {advice}");
}
