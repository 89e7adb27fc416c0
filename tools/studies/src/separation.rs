//! `coact separation`: how near the working robot comes to recorded people.

mod tables;

use anyhow::{Result, bail};
use coact::installation::Installation;
use coact_evaluation::{Encounter, Encounters, encounter};
use coact_pipeline::{RunSettings, WorldMode};
use coact_recordings::{ArmRecording, ArmSide, arm_files};
use coact_run_records::SeparationReport;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::path::{Path, PathBuf, absolute};
use std::process::ExitCode;

/// Lets the robot work while the arms of recorded people move in its workspace, and measures the
/// separation against the truth.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact separation                          each recorded arm once, in the kinematic world
  coact separation --encounters 80 --seed 7 twice, elsewhere
  coact separation --physics --json         in the physics world, every encounter for programs
  coact separation DIR                      other people's motion capture

DIR holds files of motion capture (.csv), or folders of them: t_s, then x_mm, y_mm and z_mm of
left_shoulder, left_elbow, left_hand and of the right ones. The arm moves as it was recorded, whatever
the robot does; it is put into the robot's workspace by the seed. Instead of by the network the robot
is told what to do, one thing after the other, so that it moves; no handover is among it.

Exit status: 0, or 2 for bad usage or files.")]
pub struct Args {
    /// Folder of motion capture [default: ../shared/data/motion-capture beside the checkout; skipped
    /// where it is absent]
    dir: Option<PathBuf>,
    /// How many encounters [default: one for each recorded arm]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    encounters: Option<u64>,
    /// Seed of the first encounter; the others follow
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// In the physics world instead of the kinematic one
    #[arg(long)]
    physics: bool,
    /// How many encounters at the same time [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    json: bool,
}

/// What is printed as JSON.
#[derive(Debug, Serialize)]
struct Separation {
    world: &'static str,
    seed: u64,
    total: Total,
    encounters: Vec<Encounter>,
}

/// All encounters together.
#[derive(Debug, Serialize)]
struct Total {
    encounters: usize,
    /// Those in which the robot's arm moved.
    robot_moved: usize,
    /// Those in which it closed what was nearer than the protective separation.
    robot_closed: usize,
    moved_ms: u64,
    handover_ms: u64,
    separation: SeparationReport,
}

/// Where the recordings lie that are not shipped, from the checkout's root.
const RECORDINGS: &str = "../shared/data/motion-capture";

/// Runs all encounters and prints what was measured.
///
/// # Errors
/// A folder, file or setting is refused.
pub fn run(args: Args) -> Result<ExitCode> {
    let Installation { configuration, .. } = Installation::find()?;
    let Some(folder) = folder(&args, &configuration) else {
        eprintln!(
            "skipped: the recordings are not here ({RECORDINGS}); they are not shipped. Name a folder of motion capture"
        );
        return Ok(ExitCode::SUCCESS);
    };
    let arms = arms(&folder)?;
    let count = args.encounters.unwrap_or(arms.len() as u64);
    if args.seed.checked_add(count).is_none() {
        bail!("--seed {}: too large for {count} encounters", args.seed);
    }
    let world = if args.physics { WorldMode::Physics } else { WorldMode::Kinematic };
    let settings = RunSettings { seed: args.seed, world, ..RunSettings::shipped(&configuration) };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = args.threads.map_or(cores, usize::from);
    let style = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}, {eta} left")?;
    let bar = ProgressBar::new(count).with_style(style).with_message("encounters");
    let encounters = Encounters { settings: &settings, arms: &arms, count, threads };
    let encounters = encounter(&encounters, || bar.inc(1));
    bar.finish_and_clear();
    let encounters = encounters?;
    let separation =
        Separation { world: world.name(), seed: args.seed, total: Total::of(&encounters), encounters };
    match args.json {
        true => println!("{}", serde_json::to_string_pretty(&separation)?),
        false => tables::print(&separation, &folder),
    }
    Ok(ExitCode::SUCCESS)
}

/// The folder of the recordings; none when none is named and the usual one is absent.
fn folder(args: &Args, configuration: &Path) -> Option<PathBuf> {
    let usual = || configuration.parent().map(|root| root.join(RECORDINGS)).filter(|folder| folder.is_dir());
    args.dir.clone().or_else(usual)
}

/// Every arm of every file of the folder. A file that cannot be used is an error; an arm that was hardly seen is left out, with
/// a word.
fn arms(folder: &Path) -> Result<Vec<(PathBuf, ArmSide)>> {
    let mut arms = Vec::new();
    for file in arm_files(folder)? {
        for side in ArmSide::BOTH {
            match ArmRecording::read(&file, side) {
                Ok(_) => arms.push((absolute(&file)?, side)),
                Err(error) if error.is_unseen() => eprintln!("left out: {error}"),
                Err(error) => return Err(error.into()),
            }
        }
    }
    if arms.is_empty() {
        bail!("{}: no recording shows an arm for long enough", folder.display());
    }
    Ok(arms)
}

impl Total {
    fn of(encounters: &[Encounter]) -> Self {
        let mut separation = SeparationReport::default();
        for one in encounters.iter().map(|encounter| &encounter.separation) {
            separation.ticks += one.ticks;
            separation.nearest_m = smaller(separation.nearest_m, one.nearest_m);
            separation.smallest_margin_m = smaller(separation.smallest_margin_m, one.smallest_margin_m);
            separation.robot_closing_ms += one.robot_closing_ms;
            separation.person_closing_ms += one.person_closing_ms;
            separation.contact_ms += one.contact_ms;
            separation.contact_speed_mps = separation.contact_speed_mps.max(one.contact_speed_mps);
            separation.held_back_ms += one.held_back_ms;
            separation.stopped_ms += one.stopped_ms;
        }
        let count = |is_so: &dyn Fn(&Encounter) -> bool| encounters.iter().filter(|one| is_so(one)).count();
        Self {
            encounters: encounters.len(),
            robot_moved: count(&Encounter::robot_moved),
            robot_closed: count(&|one| one.separation.robot_closing_ms > 0),
            moved_ms: encounters.iter().map(|one| one.moved_ms).sum(),
            handover_ms: encounters.iter().map(|one| one.handover_ms).sum(),
            separation,
        }
    }
}

/// The smaller one of those that there are.
fn smaller(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    [one, other].into_iter().flatten().min_by(f64::total_cmp)
}
