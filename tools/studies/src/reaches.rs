//! `coact reaches`: how often, and how long before contact, the right goal is inferred from real people's reaches.

mod real_time;
mod tables;

use anyhow::{Result, bail};
use clap::ValueEnum;
use coact::closed_pipe;
use coact::installation::Installation;
use coact::report_folder::unused_report_folder;
use coact_joint_task::NetworkPlan;
use coact_perception::PreshapeModel;
use coact_reaches::{Evaluation, ReachOutcome, ReachesReport, Subject};
use coact_recordings::{Order, Reach, read_folder};
use coact_robot::Robot;
use real_time::{RealTime, RealTimeMetrics};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Measures anticipation on recorded reaches of real people, each unseen in training.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact reaches                                all people, one left out at a time, in lockstep
  coact reaches --json > reaches.json          every reach, for programs
  coact reaches --realtime --person 3          one person, through the process set at 1 kHz
  coact reaches DIR                            other people's reaches
  coact reaches DIR --model rt-config/perception/preshape.toml")]
pub struct Args {
    /// Folder of recorded reaches, one CSV file for each person [default: the shipped data/reaches]
    dir: Option<PathBuf>,
    /// Plans that leave several goals possible [default: three objects of different size, and small
    /// against large]
    #[arg(long, value_name = "FILE")]
    task: Vec<PathBuf>,
    /// Model of preshaping, trained on other people; without it, one person of the folder is left out at a time
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// Test these participants only; the others still serve for training
    #[arg(long, value_name = "N")]
    person: Vec<u32>,
    /// Through the process set in real time: takes as long as the reaches took
    #[arg(long)]
    realtime: bool,
    /// Where reports of real-time runs go [default: reports/DATE-TIME]
    #[arg(long, value_name = "DIR", requires = "realtime")]
    report: Option<PathBuf>,
    /// Order of a person's reaches: perception adapts to those that it has seen
    #[arg(long, value_enum, default_value_t = Sequence::Trial)]
    order: Sequence,
    /// Seed of the order within equal trial numbers, and of the fields' noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print one JSON document instead of tables
    #[arg(long)]
    json: bool,
}

/// In which order a person's reaches are replayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Sequence {
    /// By the number of the trial, as the experiment was made
    Trial,
    /// As in the file: sorted by size
    File,
}

/// A report, and how the process set fared while it was made.
#[derive(Debug, Serialize)]
struct Measured {
    #[serde(flatten)]
    report: ReachesReport,
    /// Empty in lockstep.
    real_time: Vec<RealTimeMetrics>,
}

/// The recordings that are replayed, and where they were read.
struct Recordings {
    folder: PathBuf,
    reaches: Vec<Reach>,
}

/// Replays all reaches under each plan and prints what was decided.
///
/// # Errors
/// When recordings, task or model are refused, no reach is for a part of the task, or a run was given up.
pub fn run(args: Args) -> Result<ExitCode> {
    if args.realtime && args.order == Sequence::File {
        bail!("--order file: in real time reaches are played by trial only; leave out --order or --realtime");
    }
    let installation = Installation::find()?;
    let recordings = recordings(&args, &installation)?;
    let below = |file: &str| installation.configuration.join("tasks").join(file);
    let tasks = match args.task.is_empty() {
        true => ["three-objects.toml", "two-objects.toml"].map(below).to_vec(),
        false => args.task.clone(),
    };
    let report = args.report.clone().unwrap_or_else(|| unused_report_folder(Path::new("reports")));
    let measured: Vec<Measured> = tasks
        .iter()
        .map(|task| measure(&args, &installation, task, &recordings, &report))
        .collect::<Result<_>>()?;
    closed_pipe::ends_the_program();
    if args.json {
        println!("{}", serde_json::to_string_pretty(&measured)?);
    } else {
        let unseen = match args.model {
            Some(_) => "the model file is of other people",
            None => "one person left out at a time",
        };
        measured.iter().for_each(|measured| tables::print(measured, unseen));
    }
    Ok(ExitCode::SUCCESS)
}

fn recordings(args: &Args, installation: &Installation) -> Result<Recordings> {
    let folder = args.dir.clone().unwrap_or_else(|| installation.reaches.clone());
    let reaches = read_folder(&folder)?;
    let known = |person: &u32| reaches.iter().any(|reach| reach.participant == *person);
    if let Some(unknown) = args.person.iter().find(|person| !known(person)) {
        bail!("--person {unknown}: {} holds no reach of this participant", folder.display());
    }
    Ok(Recordings { folder, reaches })
}

/// What is decided about the reaches under one plan.
fn measure(
    args: &Args,
    installation: &Installation,
    path: &Path,
    recordings: &Recordings,
    report: &Path,
) -> Result<Measured> {
    let (task, plan) = NetworkPlan::load(path)?;
    let robot = Robot::load(&installation.configuration.join("robots/aros.toml"))?;
    let model = args.model.as_deref().map(PreshapeModel::load).transpose()?;
    let order = match args.order {
        Sequence::Trial => Order::Trial { seed: args.seed },
        Sequence::File => Order::File,
    };
    let evaluation =
        Evaluation { task: &task, plan: &plan, robot: &robot, model: model.as_ref(), order, seed: args.seed };
    let mut subjects = evaluation.subjects(&recordings.reaches)?;
    subjects.retain(|subject| args.person.is_empty() || args.person.contains(&subject.participant));
    if subjects.is_empty() {
        bail!("{}: no recorded reach is for a part of this task's widths", path.display());
    }
    let (outcomes, real_time) = match args.realtime {
        false => (evaluation.in_lockstep(&subjects)?, Vec::new()),
        true => {
            let report = report.join(path.file_stem().unwrap_or_default());
            let recordings = &recordings.folder;
            let player = RealTime { installation, evaluation, task: path, recordings, report: &report };
            play_all(&player, &subjects)?
        }
    };
    Ok(Measured { report: ReachesReport::new(&task.name, task.kinds.len(), outcomes), real_time })
}

fn play_all(player: &RealTime, subjects: &[Subject]) -> Result<(Vec<ReachOutcome>, Vec<RealTimeMetrics>)> {
    let (mut outcomes, mut real_time) = (Vec::new(), Vec::new());
    for (index, subject) in subjects.iter().enumerate() {
        let (count, participant) = (subject.replay.reaches().len(), subject.participant);
        eprintln!("person {participant} ({} of {}): {count} reaches", index + 1, subjects.len());
        let (judged, metrics) = player.play(subject)?;
        outcomes.extend(judged);
        real_time.push(metrics);
    }
    Ok((outcomes, real_time))
}
