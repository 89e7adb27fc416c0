//! `coact bench latency`: a real set, an idle thread and a raw hop, under load and with kills.

use anyhow::{Context, Result, bail};
use coact::installation::Installation;
use coact::report_folder::unused_report_folder;
use coact_bench::{BenchError, LatencyReport, Load, Measured, RawHop, RunningLoad, SlowCycles, kills, page};
use coact_joint_task::NetworkPlan;
use coact_monitor::PipelineNode;
use coact_pipeline::{Pipeline, Run, RunSettings, WorldMode};
use coact_run_records::Percentiles;
use coact_supervisor::{Ending, Launch};
use comfy_table::{Table, presets::UTF8_HORIZONTAL_ONLY};
use std::path::{Path, PathBuf, absolute};
use std::process::{Command, ExitCode};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Runs a real set under load, kills each process of its chain once a minute, and measures beside it an idle thread of equal
/// priority and the same payload through iceoryx2 alone.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact bench latency                               a minute on the machine as it is
  coact bench latency --minutes 10 --load all       ... ten, with cpu, memory and io busy
  coact bench latency --load cpu --out reports/cpu  ... with a page and the run's report

Exit status: 0 measured, 2 bad usage or configuration.")]
pub struct Args {
    /// How long it measures, minutes
    #[arg(long, value_name = "M", default_value_t = 1.0, value_parser = minutes)]
    minutes: f64,
    /// What else the machine has to do (by stress-ng): none, cpu, memory, io or all
    #[arg(long, default_value = "none")]
    load: Load,
    /// Seed of the run
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How the world computes: physics, or kinematic
    #[arg(long, default_value = "physics")]
    world: WorldMode,
    /// Print one JSON document instead of the tables
    #[arg(long)]
    json: bool,
    /// Where latency.html, latency.json and the run's report go [default: reports/DATE-TIME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Nobody looks longer.
const MOST_MINUTES: f64 = 24.0 * 60.0;
/// What the run takes beyond its duration, at most: its start and its end.
const AROUND: Duration = Duration::from_secs(60);

fn minutes(text: &str) -> Result<f64, String> {
    let found = text.parse::<f64>().ok().filter(|minutes| *minutes > 0.0 && *minutes <= MOST_MINUTES);
    found.ok_or_else(|| format!("expected minutes, above 0 and up to {MOST_MINUTES}, for example 1 or 0.5"))
}

/// Measures and shows.
///
/// # Errors
/// As [`super::run`].
pub fn run(args: Args) -> Result<ExitCode> {
    let out = absolute(args.out.clone().unwrap_or_else(|| unused_report_folder(Path::new("reports"))))?;
    let (launch, chain) = prepare(&args, &out)?;
    let duration = launch.settings.duration.unwrap_or_default();
    let load = RunningLoad::start(args.load, duration + AROUND)?;
    let pipeline = launch.pipeline.clone();
    let first = chain.first().cloned().unwrap_or_default();
    let mut sender = Command::new(std::env::current_exe()?);
    sender.args(["bench", "send-raw"]);
    let observe = |run: &Run, over: &AtomicBool| watch(run, over, &pipeline, &mut sender, chain);
    let (ending, seen) = launch.run_with_observer(observe)?;
    drop(load);
    if ending == Ending::Interrupted {
        bail!("interrupted");
    }
    let (raw, slow) = seen?;
    let measured = Measured::read(&out, args.load, &first, raw.histogram, slow)?;
    let json = serde_json::to_string_pretty(&measured.report)?;
    for (name, text) in [("latency.html", &page(&measured)?), ("latency.json", &json)] {
        let path = out.join(name);
        std::fs::write(&path, text).with_context(|| format!("{}: cannot be written", path.display()))?;
    }
    println!("{}", if args.json { json } else { text(&measured.report, &out) });
    Ok(ExitCode::SUCCESS)
}

/// The run, and the processes of its chain.
fn prepare(args: &Args, out: &Path) -> Result<(Launch, Vec<String>)> {
    let Installation { programs, configuration, .. } = Installation::find()?;
    let duration = Duration::from_secs_f64(60.0 * args.minutes);
    let settings = RunSettings {
        report: out.to_owned(),
        seed: args.seed,
        duration: Some(duration),
        world: args.world,
        ..RunSettings::shipped(&configuration)
    };
    let pipeline = Pipeline::of_run(&settings)?;
    let chain: Vec<String> = PipelineNode::all(&pipeline).into_iter().map(|node| node.process).collect();
    let (task, _) = NetworkPlan::load(&settings.task)?;
    let injections = kills(&chain, duration);
    let launch = Launch { settings, pipeline, task, programs, injections };
    Ok((launch, chain))
}

/// Measures what the run's own monitor does not: the raw hop, and the slowest cycles.
fn watch(
    run: &Run,
    over: &AtomicBool,
    pipeline: &Pipeline,
    sender: &mut Command,
    chain: Vec<String>,
) -> Result<(RawHop, SlowCycles), BenchError> {
    let mut slow = SlowCycles::new(chain);
    std::thread::scope(|scope| {
        let raw = scope.spawn(|| RawHop::measure(run, pipeline, sender, over));
        let watched = slow.watch(run, over);
        let raw = raw.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        watched.and(raw)
    })
    .map(|raw| (raw, slow))
}

fn text(report: &LatencyReport, out: &Path) -> String {
    let mut text = format!("{}\n", latencies(report));
    if let Some(over) = report.end_to_end_over_idle {
        text += &format!("while all lived, end to end p99.9 is {over:.1} times the idle thread's\n");
    }
    text += &format!("\n{}\n\n{}\n", kill_table(report), slow_table(report));
    text + &format!("page          {}", out.join("latency.html").display())
}

fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_HORIZONTAL_ONLY);
    table.set_header(header);
    table
}

fn us(ns: u64) -> String {
    format!("{:.1}", ns as f64 / 1e3)
}

fn latencies(report: &LatencyReport) -> Table {
    let mut rows = table(&["µs", "count", "p50", "p99", "p99.9", "max", "p50 / raw"]);
    let mut add = |name: &str, of: &Percentiles, over: Option<&f64>| {
        let over = over.map_or_else(String::new, |over| format!("{over:.2}"));
        let Percentiles { count, p50, p99, p999, max } = *of;
        rows.add_row([name.to_owned(), count.to_string(), us(p50), us(p99), us(p999), us(max), over]);
    };
    add("end to end", &report.end_to_end, None);
    add("... while all lived", &report.end_to_end_whole, None);
    for (name, hop) in &report.hops {
        add(name, hop, report.hop_over_raw.get(name));
    }
    add("raw hop", &report.raw_hop, None);
    if let Some(machine) = report.environment.machine {
        let cells = [machine.wakeups.to_string(), String::new(), String::new()];
        let [count, p50, p99] = cells;
        let (p999, longest) = (us(machine.p999_ns), us(machine.longest_ns));
        rows.add_row(["idle thread".to_owned(), count, p50, p99, p999, longest, String::new()]);
    }
    rows
}

fn kill_table(report: &LatencyReport) -> Table {
    let mut rows = table(&["killed", "at s", "seen ms", "recovered ms", "others missed"]);
    let ms = |value: Option<f64>| value.map_or_else(|| "never".to_owned(), |ms| format!("{ms:.1}"));
    for kill in &report.kills {
        let (at, missed) = (format!("{:.1}", kill.at_s), kill.survivors_missed.to_string());
        rows.add_row([kill.process.clone(), at, ms(kill.detected_ms), ms(kill.recovered_ms), missed]);
    }
    rows
}

fn slow_table(report: &LatencyReport) -> Table {
    let mut rows = table(&["slowest cycle", "end to end", "µs after the release: due, started, published"]);
    for cycle in &report.slowest {
        let stage = |stage: &coact_bench::StageTimes| {
            let [due, started, published] =
                [stage.due_ns, stage.started_ns, stage.published_ns].map(|ns| ns / 1000);
            format!("{} {due}, {started}, {published}", stage.process)
        };
        let stages: Vec<_> = cycle.stages.iter().map(stage).collect();
        rows.add_row([cycle.cycle.to_string(), us(cycle.end_to_end_ns), stages.join("; ")]);
    }
    rows
}
