//! `coact task show FILE`: what is made of a task file.

use anyhow::Context;
use coact_joint_task::{NetworkPlan, Population, Task};
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `coact task show`.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  coact task show rt-config/tasks/toy-vehicle.toml")]
pub struct Args {
    /// The task file.
    file: PathBuf,
    /// Print one JSON object instead of tables.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// A task or network file that cannot be read as one, with file, line and key.
pub fn run(args: Args) -> anyhow::Result<ExitCode> {
    let Args { file, json } = args;
    let (task, plan) = NetworkPlan::load(&file)?;
    if json {
        let text = serde_json::to_string_pretty(&as_json(&task, &plan)).context("cannot print as JSON")?;
        println!("{text}");
        return Ok(ExitCode::SUCCESS);
    }
    println!(
        "{}: {} subgoals, {} populations in {} layers, {} synapses\n",
        task.name,
        task.subgoals.len(),
        plan.populations.len(),
        plan.layers.len(),
        plan.synapses.len()
    );
    println!("{}\n\n{}", populations(&plan), synapses(&plan));
    Ok(ExitCode::SUCCESS)
}

fn populations(plan: &NetworkPlan) -> Table {
    let mut table = table(["layer", "population", "role"]);
    for layer in &plan.layers {
        for population in &plan.populations[layer.populations.clone()] {
            table.add_row([layer.kind.name(), &population.label, &population.role.to_string()]);
        }
    }
    table
}

fn synapses(plan: &NetworkPlan) -> Table {
    let mut table = table(["from", "to", "weight", "because"]);
    for synapse in &plan.synapses {
        table.add_row([
            full_label(plan, synapse.from),
            full_label(plan, synapse.to),
            format!("{:+.2}", synapse.weight),
            plan.reasons[synapse.rule].clone(),
        ]);
    }
    table
}

fn table<const COLUMNS: usize>(header: [&str; COLUMNS]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(header);
    table
}

/// Layer and label of the population or channel of this index.
fn full_label(plan: &NetworkPlan, index: usize) -> String {
    let Population { label, .. } = plan.meaning(index);
    format!("{} · {label}", plan.layer_of(index).map_or("percept", |layer| layer.kind.name()))
}

fn as_json(task: &Task, plan: &NetworkPlan) -> serde_json::Value {
    let populations: Vec<_> = (0..plan.populations.len()).map(|index| full_label(plan, index)).collect();
    let synapses: Vec<_> = plan
        .synapses
        .iter()
        .map(|synapse| {
            serde_json::json!({
                "from": full_label(plan, synapse.from),
                "to": full_label(plan, synapse.to),
                "weight": synapse.weight,
                "because": plan.reasons[synapse.rule],
            })
        })
        .collect();
    serde_json::json!({ "task": task.name, "populations": populations, "synapses": synapses })
}
