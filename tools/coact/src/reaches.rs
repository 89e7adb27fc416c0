//! `coact reaches`: how often, and how long before contact, the right goal is inferred from real people's reaches.

use anyhow::bail;
use clap::ValueEnum;
use coact_joint_task::NetworkPlan;
use coact_perception::PreshapeModel;
use coact_reaches::{Evaluation, Order, Report, Tally, evaluate};
use coact_recordings::read_folder;
use comfy_table::{CellAlignment, Table, presets};
use std::path::PathBuf;
use std::process::ExitCode;

/// What `coact reaches` is asked.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Folder of recorded reaches, one CSV file for each person
    dir: PathBuf,
    /// Plans that leave some goals; default: three objects of different size, and small against large
    #[arg(long)]
    task: Vec<PathBuf>,
    /// Model of preshaping, trained on other people; without it, one person of the folder is left out at a time
    #[arg(long)]
    model: Option<PathBuf>,
    /// Order of a person's reaches, from which perception learns on the way
    #[arg(long, value_enum, default_value_t = Sequence::Trial)]
    order: Sequence,
    /// Seed of the order within equal trial numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON document instead of tables
    #[arg(long)]
    json: bool,
}

/// In which order a person's reaches are replayed.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Sequence {
    /// By the number of the trial, as the experiment was made
    Trial,
    /// As in the file: sorted by size
    File,
}

const DEFAULT_TASKS: [&str; 2] = ["rt-config/tasks/three-objects.toml", "rt-config/tasks/two-objects.toml"];

/// Replays all reaches under each plan and prints what was decided.
///
/// # Errors
/// When recordings, task or model are refused, or no reach is for a part of the task.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    let reaches = read_folder(&args.dir)?;
    let model = args.model.as_deref().map(PreshapeModel::load).transpose()?;
    let order = match args.order {
        Sequence::Trial => Order::Trial { seed: args.seed },
        Sequence::File => Order::File,
    };
    let tasks = if args.task.is_empty() { DEFAULT_TASKS.map(PathBuf::from).to_vec() } else { args.task };
    let mut reports = Vec::new();
    for path in &tasks {
        let (task, plan) = NetworkPlan::load(path)?;
        let outcomes =
            evaluate(Evaluation { task: &task, plan: &plan, model: model.as_ref(), order }, &reaches)?;
        if outcomes.is_empty() {
            bail!("{}: no recorded reach is for a part of this task's widths", path.display());
        }
        reports.push(Report::new(&task.name, task.kinds.len(), outcomes));
    }
    if args.json {
        println!("{}", serde_json::to_string_pretty(&reports)?);
    } else {
        let unseen = if model.is_some() {
            "the model file is of other people"
        } else {
            "one person left out at a time"
        };
        reports.iter().for_each(|report| print(report, unseen));
    }
    Ok(ExitCode::SUCCESS)
}

fn print(report: &Report, unseen: &str) {
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
