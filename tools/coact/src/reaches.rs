//! `coact reaches`: how often, and how long before contact, the right goal is inferred from real people's reaches.

mod real_time;

use crate::closed_pipe;
use crate::folder_name::unused_report_folder;
use crate::installation::Installation;
use anyhow::{Result, bail};
use clap::ValueEnum;
use coact_joint_task::NetworkPlan;
use coact_perception::PreshapeModel;
use coact_reaches::{Evaluation, Outcome, Report, Subject, Tally};
use coact_recordings::{Order, Reach, read_folder};
use coact_robot::Robot;
use comfy_table::{CellAlignment, Table, presets};
use real_time::{RealTime, Regularity};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Measures anticipation on recorded reaches of real people, each unseen in training.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact reaches DIR                                   all people, one left out at a time, as fast as possible
  coact reaches DIR --json > reaches.json             every reach, for programs
  coact reaches DIR --realtime --person 3             one person, through the process set at 1 kHz
  coact reaches DIR --model rt-config/perception/preshape.toml")]
pub struct Args {
    /// Folder of recorded reaches, one CSV file for each person
    dir: PathBuf,
    /// Plans that leave some goals [default: three objects of different size, and small against large]
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
    /// Order of a person's reaches, from which perception learns on the way
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
    report: Report,
    /// Empty in lockstep.
    real_time: Vec<Regularity>,
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
    let below = |file: &str| installation.configuration.join("tasks").join(file);
    let tasks = match args.task.is_empty() {
        true => ["three-objects.toml", "two-objects.toml"].map(below).to_vec(),
        false => args.task.clone(),
    };
    let reaches = read_folder(&args.dir)?;
    if let Some(unknown) =
        args.person.iter().find(|person| reaches.iter().all(|reach| reach.participant != **person))
    {
        bail!("--person {unknown}: {} holds no reach of this participant", args.dir.display());
    }
    let report = args.report.clone().unwrap_or_else(|| unused_report_folder(Path::new("reports")));
    let measured: Vec<Measured> = tasks
        .iter()
        .map(|task| measure(&args, &installation, task, &reaches, &report))
        .collect::<Result<_>>()?;
    closed_pipe::ends_the_program();
    if args.json {
        println!("{}", serde_json::to_string_pretty(&measured)?);
    } else {
        let unseen = match args.model {
            Some(_) => "the model file is of other people",
            None => "one person left out at a time",
        };
        measured.iter().for_each(|measured| print(measured, unseen));
    }
    Ok(ExitCode::SUCCESS)
}

/// What comes of the reaches under one plan.
fn measure(
    args: &Args,
    installation: &Installation,
    path: &Path,
    reaches: &[Reach],
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
    let mut subjects = evaluation.subjects(reaches)?;
    subjects.retain(|subject| args.person.is_empty() || args.person.contains(&subject.participant));
    if subjects.is_empty() {
        bail!("{}: no recorded reach is for a part of this task's widths", path.display());
    }
    let (outcomes, real_time) = match args.realtime {
        false => (evaluation.in_lockstep(&subjects)?, Vec::new()),
        true => {
            let report = report.join(path.file_stem().unwrap_or_default());
            let stage =
                RealTime { installation, evaluation, task: path, recordings: &args.dir, report: &report };
            play_all(&stage, &subjects)?
        }
    };
    Ok(Measured { report: Report::new(&task.name, task.kinds.len(), outcomes), real_time })
}

fn play_all(stage: &RealTime, subjects: &[Subject]) -> Result<(Vec<Outcome>, Vec<Regularity>)> {
    let (mut outcomes, mut real_time) = (Vec::new(), Vec::new());
    for (index, subject) in subjects.iter().enumerate() {
        let (count, participant) = (subject.replay.reaches().len(), subject.participant);
        eprintln!("person {participant} ({} of {}): {count} reaches", index + 1, subjects.len());
        let (judged, regularity) = stage.play(subject)?;
        outcomes.extend(judged);
        real_time.push(regularity);
    }
    Ok((outcomes, real_time))
}

fn print(measured: &Measured, unseen: &str) {
    let Measured { report, real_time } = measured;
    let Tally { reaches, .. } = report.overall;
    println!("\n{}: {} goals possible, {reaches} reaches, {unseen}", report.task, report.goals);
    let mut table = Table::new();
    table.load_style(presets::UTF8_HORIZONTAL_ONLY);
    table.set_header([
        "person",
        "reaches",
        "right",
        "wrong",
        "none",
        "20 %",
        "40 %",
        "60 %",
        "80 %",
        "100 %",
        "lead p5 p50 p95",
        "onset p5 p50 p95",
    ]);
    for (person, tally) in &report.people {
        table.add_row(row(&format!("p{person}"), tally));
    }
    table.add_row(row("all", &report.overall));
    table.column_iter_mut().skip(1).for_each(|column| column.set_cell_alignment(CellAlignment::Right));
    println!("{table}");
    println!(
        "right: decided before contact, of all reaches. 20 % ...: right goal standing at that part of movement time.\n\
         lead: contact minus decision, ms. onset: perception's minus the label, ms."
    );
    for Regularity { participant, cycles, missed, end_to_end_p99_ns, report, .. } in real_time {
        println!(
            "p{participant} in real time: {cycles} cycles, {missed} missed by any process, end to end p99 {} µs; {}",
            end_to_end_p99_ns / 1000,
            report.display()
        );
    }
}

fn row(name: &str, tally: &Tally) -> Vec<String> {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let spread = |values: Option<[i64; 3]>| values.map_or("-".into(), |[a, b, c]| format!("{a} {b} {c}"));
    let mut cells = vec![name.to_owned(), tally.reaches.to_string(), percent(tally.right_share)];
    cells.extend([tally.wrong.to_string(), tally.undecided.to_string()]);
    cells.extend(tally.standing_right.map(percent));
    cells.extend([spread(tally.lead_ms), spread(tally.onset_ms)]);
    cells
}
