//! `coact motion bench`: the planner on a suite of randomised movements.

use super::robot::RobotArgs;
use anyhow::{Result, bail};
use coact_motion_suite::{Measurement, Scenario, Setting, measure};
use comfy_table::{CellAlignment, Table, presets};
use indicatif::{ProgressBar, ProgressStyle};
use owo_colors::{OwoColorize, Stream};
use std::path::PathBuf;
use std::process::ExitCode;

/// Measures the planner on randomised movements: planning time, success, smoothness.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact motion bench                                  all scenarios, 50 random cases each
  coact motion bench --only pick,insert --cases 500   these, for longer
  coact motion bench --robot arm.urdf --missing-meshes capsules
  coact motion bench --hand hand.urdf                 our arm with the hand of another URDF
  coact motion bench --json > bench.json              every metric, for programs")]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Task at which the robot picks and inserts [default: the toy vehicle]
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// Scenarios, with commas between [default: all that the robot can do]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Vec<String>,
    /// Random cases of each scenario
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..))]
    cases: u32,
    /// Seed of the cases
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
}

/// Measures and prints.
///
/// # Errors
/// A robot or task that is refused, or a scenario that does not exist.
pub fn run(args: Args) -> Result<ExitCode> {
    let setting = args.robot.setting(args.task.as_ref())?;
    let scenarios = scenarios(&args.only, &setting)?;
    let count = u64::from(args.cases);
    let bar = ProgressBar::new(count * scenarios.len() as u64)
        .with_style(ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}")?);
    let mut measured = Vec::new();
    for scenario in scenarios {
        bar.set_message(scenario.name());
        measured.push((
            scenario,
            measure(&setting, scenario, args.cases as usize, args.seed, &mut || bar.inc(1)),
        ));
    }
    bar.finish_and_clear();
    if args.json {
        let all: Vec<&Measurement> = measured.iter().map(|(_, measurement)| measurement).collect();
        println!("{}", serde_json::to_string_pretty(&all)?);
    } else {
        print(&measured);
    }
    Ok(ExitCode::SUCCESS)
}

/// The scenarios of these names, or all; without those that this robot cannot do.
fn scenarios(names: &[String], setting: &Setting) -> Result<Vec<Scenario>> {
    let known = Scenario::ALL.map(Scenario::name);
    if let Some(unknown) = names.iter().find(|name| !known.contains(&name.as_str())) {
        bail!("--only {unknown}: no such scenario; there are {}", known.join(", "));
    }
    let chosen = |scenario: &Scenario| names.is_empty() || names.iter().any(|name| name == scenario.name());
    let able = |scenario: &Scenario| setting.hand.is_some() || !scenario.needs_hand();
    let scenarios: Vec<Scenario> = Scenario::ALL.into_iter().filter(chosen).filter(able).collect();
    if scenarios.is_empty() {
        bail!(
            "--only {}: needs a robot file (.toml) with its own hand: a URDF does not say how a hand grips",
            names.join(", ")
        );
    }
    Ok(scenarios)
}

fn print(measured: &[(Scenario, Measurement)]) {
    let mut table = Table::new();
    table.load_style(presets::UTF8_HORIZONTAL_ONLY);
    table.set_header([
        "scenario",
        "solved",
        "median ms",
        "p99 ms",
        "budget",
        "one unit",
        "jerk",
        "bounced",
        "time s",
        "of shortest",
        "error mm",
        "clearance mm",
    ]);
    for (scenario, one) in measured {
        let [median, p99, _] = one.planning_ms;
        let (budget, largest) = scenario.budget_ms();
        let within = median <= budget && largest.is_none_or(|largest| p99 <= largest);
        let verdict = match one.solved {
            0 => "none solved".to_owned(),
            _ => format!("{} {budget:.0}", if within { "within" } else { "above" }),
        };
        table.add_row([
            one.scenario.to_owned(),
            format!("{} of {}", one.solved, one.solvable),
            format!("{median:.1}"),
            format!("{p99:.1}"),
            verdict,
            format!("{:.0} %", 100.0 * one.single_unit),
            format!("{:.0}", one.normalised_jerk),
            format!("{:.0} %", 100.0 * one.bounced),
            format!("{:.2}", one.duration_s),
            format!("{:.2}", one.over_shortest),
            format!("{:.2}", 1e3 * one.position_error),
            format!("{:.0}", 1e3 * one.clearance),
        ]);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    println!("{table}");
    for (_, one) in measured {
        for refusal in &one.refusals {
            let line = format!("{}: {refusal}", one.scenario);
            println!("{}", line.if_supports_color(Stream::Stdout, |text| text.dimmed()));
        }
    }
}
