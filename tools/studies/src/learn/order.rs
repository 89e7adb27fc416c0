//! `coact learn order`: a task's plan from demonstrations.

use anyhow::{Context, Result, ensure};
use coact::installation::Installation;
use coact_joint_task::{NetworkPlan, Task};
use coact_learning::{Demonstration, LearnedOrder, SerialOrder, TaskText};
use comfy_table::{CellAlignment, Table, presets};
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `coact learn order`.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  coact learn order --demonstrations rt-config/demonstrations/toy-vehicle/*.toml --out mine.toml
  coact learn order --demonstrations reports/* --task table.toml --out mine.toml
  coact launch --lockstep --task mine.toml

A demonstration is a .toml file with tables [[achieved]] (keys seconds, subgoal), a .csv file with
columns seconds,subgoal, or the report of a run. Orders may differ: what differs is no condition.")]
pub struct Args {
    /// What was seen: files or report folders
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    demonstrations: Vec<PathBuf>,
    /// Where the task with the learned plan goes
    #[arg(long, value_name = "TASKFILE")]
    out: PathBuf,
    /// The task without a plan, or whose plan is replaced [default: the toy vehicle]
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

/// What was learned from the demonstrations.
struct Learned {
    order: LearnedOrder,
    watched: usize,
    /// After how many demonstrations the plan was that of the given task, and stayed so.
    equal_after: Option<usize>,
}

/// Strength from which a connection without condition is shown: what fields at rest leave is far below. Chosen by hand.
const NEGLIGIBLE: f64 = 1e-4;

/// Learns, writes the task and prints what was learned.
///
/// # Errors
/// A task or demonstration that is refused, or a file that cannot be written.
pub fn run(args: Args) -> Result<ExitCode> {
    let base = match args.task {
        Some(task) => task,
        None => Installation::find()?.configuration.join("tasks/toy-vehicle.toml"),
    };
    let (task, plan) = NetworkPlan::load(&base)?;
    ensure!(
        task.choices.is_empty(),
        "{}: the plan has alternatives ([[choice]]); expected one in which every demonstration achieves every subgoal",
        base.display()
    );
    let names: Vec<String> = task.subgoals.iter().map(|subgoal| subgoal.name.clone()).collect();
    let mut demonstrations = Vec::new();
    for path in &args.demonstrations {
        demonstrations.extend(Demonstration::read(path, &names)?);
    }
    let learned = learn(&task, &plan, &demonstrations)?;
    let mut text = TaskText::read(&base)?;
    text.set_plan(&learned.order.plan());
    text.write(&args.out)?;
    Task::load(&args.out).with_context(|| format!("{} was written, but is no task", args.out.display()))?;
    if args.json {
        println!("{}", serde_json::to_string_pretty(&as_json(&task, &learned))?);
    } else {
        print(&task, &learned);
        println!("written to {}", args.out.display());
    }
    Ok(ExitCode::SUCCESS)
}

fn learn(task: &Task, plan: &NetworkPlan, demonstrations: &[Demonstration]) -> Result<Learned> {
    let mut learner = SerialOrder::new(plan)?;
    let given = given(task);
    let mut equal_after = None;
    for (index, demonstration) in demonstrations.iter().enumerate() {
        learner.watch(demonstration);
        let equal = learner.order().plan() == given;
        equal_after = equal.then(|| equal_after.unwrap_or(index + 1));
    }
    Ok(Learned { order: learner.order(), watched: demonstrations.len(), equal_after })
}

/// The plan of the task file, each subgoal's predecessors ascending.
fn given(task: &Task) -> Vec<Vec<usize>> {
    let sorted = |after: &Vec<usize>| {
        let mut after = after.clone();
        after.sort_unstable();
        after
    };
    task.subgoals.iter().map(|subgoal| sorted(&subgoal.after)).collect()
}

fn has_a_plan(task: &Task) -> bool {
    task.subgoals.iter().any(|subgoal| !subgoal.after.is_empty())
}

fn print(task: &Task, learned: &Learned) {
    let Learned { order, watched, equal_after } = learned;
    let plan = order.plan();
    let mut table = Table::new();
    table.load_style(presets::UTF8_HORIZONTAL_ONLY);
    table.set_header(["subgoal", "comes after", "strength", "strongest without condition"]);
    for (to, predecessors) in plan.iter().enumerate() {
        let names: Vec<_> = predecessors.iter().map(|&from| task.subgoals[from].name.as_str()).collect();
        let strengths: Vec<_> =
            predecessors.iter().map(|&from| format!("{:.2}", order.strength(from, to))).collect();
        let none = || vec!["-"];
        let names = if names.is_empty() { none() } else { names };
        let varied = strongest_varied(task, order, to);
        table.add_row([task.subgoals[to].name.clone(), names.join("\n"), strengths.join("\n"), varied]);
    }
    table
        .column_iter_mut()
        .skip(2)
        .take(1)
        .for_each(|column| column.set_cell_alignment(CellAlignment::Right));
    println!("{table}");
    println!("{watched} demonstrations watched");
    if has_a_plan(task) {
        match equal_after {
            Some(count) => println!("the learned plan equals that of the given task after {count}"),
            None => println!(
                "the learned plan is not that of the given task: demonstrate the orders that are missing"
            ),
        }
    }
}

/// Of the subgoals whose turn varied, the one with the strongest connection that is left.
fn strongest_varied(task: &Task, order: &LearnedOrder, to: usize) -> String {
    let others = (0..task.subgoals.len()).filter(|&from| from != to && !order.is_condition(from, to));
    let strongest = others.max_by(|&a, &b| order.strength(a, to).total_cmp(&order.strength(b, to)));
    let varied = strongest.filter(|&from| order.strength(from, to) > NEGLIGIBLE);
    varied.map_or("-".into(), |from| format!("{} {:.3}", task.subgoals[from].name, order.strength(from, to)))
}

fn as_json(task: &Task, learned: &Learned) -> serde_json::Value {
    let Learned { order, watched, equal_after } = learned;
    let plan = order.plan();
    let name = |index: usize| task.subgoals[index].name.as_str();
    let connections =
        (0..task.subgoals.len()).flat_map(|from| (0..task.subgoals.len()).map(move |to| (from, to)));
    let strengths: Vec<_> = connections
        .filter(|(from, to)| from != to)
        .map(|(from, to)| {
            json!({ "from": name(from), "to": name(to), "strength": order.strength(from, to),
                "direct": plan[to].contains(&from) })
        })
        .collect();
    json!({
        "task": task.name,
        "demonstrations": watched,
        "equals_given_plan_after": has_a_plan(task).then_some(equal_after).copied().flatten(),
        "connections": strengths,
    })
}
