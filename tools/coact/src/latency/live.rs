//! The metrics of a running process set, second by second.

use super::{report, show, write};
use crate::living_runs;
use anyhow::Context;
use coact_monitor::{Metrics, PipelineNode, PulseInputs};
use coact_pipeline::{Pipeline, Run};
use coact_realtime::Bus;
use coact_safety::SafetyLimits;
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How often the tables are printed anew: fast enough to follow, slow enough to read.
const SHOW_EVERY: Duration = Duration::from_secs(1);
/// How often the pulses are read: much shorter than the time in which they fill the reader's buffer.
const DRAIN_EVERY: Duration = Duration::from_millis(50);
/// ANSI: moves to the upper left and clears what is below.
const CLEAR: &str = "\x1b[H\x1b[J";

/// Attaches to a run until Ctrl-C or its end.
pub(super) fn run(id: Option<&str>, json: bool) -> anyhow::Result<()> {
    let run = living_runs::newest(id)?;
    let pipeline = Pipeline::of_run(run.settings())?;
    let bus = Bus::open(&run, "latency", 0)?;
    let nodes = PipelineNode::all(&pipeline);
    let mut pulses = PulseInputs::open(&bus, nodes.iter().map(|node| node.process.clone()))?;
    let fresh = SafetyLimits::load(&run.settings().safety)?.stale.input_after;
    let mut metrics = Metrics::new(nodes, fresh);
    let stop = Arc::new(AtomicBool::new(false));
    signal_hook::flag::register(signal_hook::consts::SIGINT, Arc::clone(&stop))
        .context("Ctrl-C cannot be caught")?;
    let mut shown = Instant::now();
    while !stop.load(Ordering::Relaxed) && run.owner_lives() && run.directory().exists() {
        std::thread::sleep(DRAIN_EVERY);
        pulses.each(|process, pulse| {
            metrics.pulse(process, pulse);
        })?;
        if shown.elapsed() >= SHOW_EVERY {
            shown = Instant::now();
            if !print(&run, &metrics, json)? {
                break;
            }
        }
    }
    Ok(())
}

/// False when nobody reads any more.
fn print(run: &Run, metrics: &Metrics, json: bool) -> anyhow::Result<bool> {
    if json {
        return write(&serde_json::to_string(&report(metrics))?);
    }
    let clear = if std::io::stdout().is_terminal() { CLEAR } else { "" };
    write(&format!("{clear}run {} since it was attached to (Ctrl-C ends)\n{}", run.id(), show(metrics)))
}
