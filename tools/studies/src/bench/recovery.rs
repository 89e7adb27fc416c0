//! `coact bench recovery`: a real set, the stages of which die again and again.

use anyhow::{Context, Result, bail, ensure};
use coact::installation::Installation;
use coact::report_folder::unused_report_folder;
use coact_bench::{ReadersOutage, Recovery, RecoveryReport, random_faults};
use coact_joint_task::NetworkPlan;
use coact_pipeline::{Pipeline, RunSettings, Trigger, WorldMode};
use coact_run_records::{Percentiles, Summary};
use coact_supervisor::{Ending, Fault, Launch};
use coact_table_edit::TableEdit;
use comfy_table::{Table, presets::UTF8_HORIZONTAL_ONLY};
use std::path::{Path, PathBuf, absolute};
use std::process::ExitCode;
use std::time::Duration;

/// Strikes fields and control by turns, at random instants, and tells for how long their readers were without them.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact bench recovery                          a hundred SIGKILLs; replacements wait, loaded
  coact bench recovery --faults 1000 --standby  a thousand; each stage has a standby
  coact bench recovery --fault stop-for-good    SIGSTOPs that nothing ends

Rows \"machine in time\" leave out faults during which the machine was late: an idle thread by half a
period or more, or the stage that starts the chain, which nobody strikes, by a cycle. With standbys, cycles
without output are told for the rest of the run as well: what faults cost is the difference.

The arm is watched as in every run: its verdict on the work is told, too.

Exit status: 0 measured, 2 bad usage or configuration.")]
pub struct Args {
    /// How many faults, both stages together
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    faults: u32,
    /// What is done to them (coact inject --help lists it)
    #[arg(long, value_name = "FAULT", default_value = "kill")]
    fault: Fault,
    /// Time from one fault to the next on the average, ms
    #[arg(long, value_name = "MS", default_value_t = 500, value_parser = clap::value_parser!(u64).range(100..=60_000))]
    every: u64,
    /// Both stages have a standby
    #[arg(long)]
    standby: bool,
    /// Seed of the run and of the instants
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How the world computes: kinematic, or physics
    #[arg(long, default_value = "kinematic")]
    world: WorldMode,
    /// Print one JSON document instead of the table
    #[arg(long)]
    json: bool,
    /// Where recovery.json and the run's report go [default: reports/DATE-TIME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Who is struck.
const STRUCK: [&str; 2] = ["fields", "control"];
/// More restarts than any bench makes; those so far apart, s, are immediate.
const INTENSITY: i64 = 1_000_000;
const WINDOW_S: f64 = 0.1;
/// How long the run goes on after the last fault.
const AFTER: Duration = Duration::from_secs(3);

/// Measures and shows.
///
/// # Errors
/// As [`super::run`].
pub fn run(args: Args) -> Result<ExitCode> {
    let out = absolute(args.out.clone().unwrap_or_else(|| unused_report_folder(Path::new("reports"))))?;
    std::fs::create_dir_all(&out)
        .with_context(|| format!("--out {}: expected a folder that can be written to", out.display()))?;
    let launch = prepare(&args, &out)?;
    let first = launch.pipeline.processes.iter().find(|process| process.trigger == Trigger::Timer);
    let first = first.context("the process table has no process with trigger = \"timer\"")?.name.clone();
    if let Ending::Interrupted = launch.run()? {
        bail!("interrupted");
    }
    let report = RecoveryReport::new(args.fault.name(), &first, &Summary::read(&out)?);
    ensure!(
        !report.processes.is_empty(),
        "the monitor has seen no {}; expected one of each stage",
        args.fault.name()
    );
    let json = serde_json::to_string_pretty(&report)?;
    let path = out.join("recovery.json");
    std::fs::write(&path, &json).with_context(|| format!("{}: cannot be written", path.display()))?;
    println!("{}", if args.json { json } else { text(&report, &out) });
    Ok(ExitCode::SUCCESS)
}

fn prepare(args: &Args, out: &Path) -> Result<Launch> {
    let Installation { programs, configuration, .. } = Installation::find()?;
    let shipped = RunSettings::shipped(&configuration);
    let with_standby = if args.standby { &STRUCK[..] } else { &[] };
    // Nobody is ever given up.
    let tireless = TableEdit::of(&configuration)?
        .with("restart", "intensity", INTENSITY)?
        .with("restart", "window_s", WINDOW_S)?
        .with_standby(with_standby)?;
    let every = Duration::from_millis(args.every);
    let injections = random_faults(&STRUCK, args.fault, args.faults as usize, every, args.seed);
    let last = injections.last().map_or(Duration::ZERO, |last| last.at);
    let settings = RunSettings {
        pipeline: tireless.write(out)?,
        report: out.to_owned(),
        seed: args.seed,
        duration: Some(last + AFTER),
        world: args.world,
        ..shipped
    };
    let pipeline = Pipeline::of_run(&settings)?;
    let (task, _) = NetworkPlan::load(&settings.task)?;
    Ok(Launch { settings, pipeline, task, programs, injections })
}

fn text(report: &RecoveryReport, out: &Path) -> String {
    let late = report.machine_late.map_or_else(String::new, |late| {
        format!("the idle thread woke up late by a period {late} times meanwhile\n")
    });
    let outage = &report.command_outage;
    let judged = if report.work.passes() { "pass".to_owned() } else { format!("{:?}", report.work) };
    let readers: String = report.readers.iter().map(|(stage, outage)| readers(stage, outage)).collect();
    format!(
        "{}\n{readers}no timely command in {} of {} cycles, {} in a row at most\n{late}work {judged}\nreport {}",
        table(report),
        outage.without_output,
        outage.due,
        outage.longest,
        out.display()
    )
}

/// What the fault itself cost the readers of a stage, beside what they miss anyway.
fn readers(stage: &str, outage: &ReadersOutage) -> String {
    let ReadersOutage { during_faults, otherwise } = outage;
    format!(
        "cycles without output of {stage}: {} of {} until it recovered ({:.1} in a thousand), {} of {} otherwise ({:.1})\n",
        during_faults.missed,
        during_faults.due,
        during_faults.per_thousand(),
        otherwise.missed,
        otherwise.due,
        otherwise.per_thousand(),
    )
}

fn table(report: &RecoveryReport) -> Table {
    let mut rows = Table::new();
    rows.load_style(UTF8_HORIZONTAL_ONLY);
    let columns = [
        "count",
        "p50 ms",
        "p99 ms",
        "max ms",
        "never",
        "others missed none",
        "cycles without output: faults",
    ];
    rows.set_header([report.fault].into_iter().chain(columns));
    for (machine, processes) in [("", &report.processes), (", machine in time", &report.machine_in_time)] {
        for (process, recovery) in processes {
            rows.add_row([format!("{process}{machine}")].into_iter().chain(cells(recovery)));
        }
    }
    rows
}

fn cells(recovery: &Recovery) -> [String; 7] {
    let Recovery { count, recovered, lost, others_missed_none, without_output } = recovery;
    let Percentiles { p50, p99, max, .. } = recovered;
    let [p50, p99, max] = [p50, p99, max].map(|ns| format!("{:.1}", *ns as f64 / 1e6));
    let missing: Vec<_> =
        without_output.iter().map(|(cycles, faults)| format!("{cycles}: {faults}")).collect();
    [count.to_string(), p50, p99, max, lost.to_string(), others_missed_none.to_string(), missing.join(", ")]
}
