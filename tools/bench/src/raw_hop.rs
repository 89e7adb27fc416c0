use crate::BenchError;
use crate::raw_port::{RawPort, prefix};
use coact_monitor::histogram;
use coact_period::PERIOD_NS;
use coact_pipeline::{Pipeline, ProcessEntry, Run};
use coact_realtime::{Schedule, SchedulingClass, now};
use hdrhistogram::Histogram;
use rustix::thread::{CpuSet, sched_setaffinity};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A hop through iceoryx2 alone: a thread publishes and notifies once a period, another one waits and receives, with the classes,
/// the core and the payload of the chain's first hop.
#[derive(Debug)]
pub struct RawHop {
    /// How long messages took, ns.
    pub histogram: Histogram<u64>,
}

/// When it sends, after the release: the chain rests then. In quarters of a period.
const QUARTER: u64 = 3;
/// How long the receiver waits before it looks whether it is to end.
const LOOK_EVERY: Duration = Duration::from_millis(100);
/// Messages in which connections are made, and every slot is used for the first time.
const WARM_UP: u64 = 1000;

impl RawHop {
    /// Measures beside a run until it is over.
    ///
    /// # Errors
    /// [`BenchError::Port`].
    pub fn measure(run: &Run, pipeline: &Pipeline, over: &AtomicBool) -> Result<Self, BenchError> {
        let folder = std::env::temp_dir().join(format!("coact-bench-{}", std::process::id()));
        let measured = std::thread::scope(|scope| {
            let real_time: Vec<&ProcessEntry> =
                pipeline.processes.iter().filter(|entry| entry.realtime).collect();
            let (first, second) = (real_time.first().copied(), real_time.get(1).copied());
            let receiver = scope.spawn({
                let folder = &folder;
                move || receive(folder, second, over)
            });
            let sent = send(scope, &folder, first, run, over);
            let received = receiver.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            sent.and(received)
        });
        // iceoryx2 leaves its count of nodes; what cannot be removed harms nobody.
        std::fs::remove_dir_all(&folder).ok();
        for entry in std::fs::read_dir("/dev/shm").into_iter().flatten().flatten() {
            if entry.file_name().to_string_lossy().starts_with(&prefix()) {
                std::fs::remove_file(entry.path()).ok();
            }
        }
        measured.map(|histogram| Self { histogram })
    }
}

/// Gives the calling thread what the process has, as far as the machine grants it.
fn become_like(entry: Option<&ProcessEntry>) {
    let Some(entry) = entry else { return };
    if let Some(core) = entry.core.filter(|core| *core < CpuSet::MAX_CPU) {
        let mut cores = CpuSet::new();
        cores.set(core);
        // Refused, it runs where the process that was refused the same does.
        let _ = sched_setaffinity(None, &cores);
    }
    let _ = SchedulingClass::Fifo(entry.priority).apply();
}

fn receive(
    folder: &Path,
    like: Option<&ProcessEntry>,
    over: &AtomicBool,
) -> Result<Histogram<u64>, BenchError> {
    let port = RawPort::open(folder, false)?;
    become_like(like);
    let (mut histogram, mut received) = (histogram(), 0);
    while !over.load(Ordering::Relaxed) {
        if let Some(took) = port.receive(LOOK_EVERY)? {
            received += 1;
            if received > WARM_UP {
                histogram.saturating_record(took);
            }
        }
    }
    Ok(histogram)
}

/// Sends on a thread of its own, so that the caller keeps its class.
fn send<'scope>(
    scope: &'scope std::thread::Scope<'scope, '_>,
    folder: &'scope Path,
    like: Option<&'scope ProcessEntry>,
    run: &'scope Run,
    over: &'scope AtomicBool,
) -> Result<(), BenchError> {
    let body = move || {
        let port = RawPort::open(folder, true)?;
        let Some(schedule) = start(run, over) else { return Ok(()) };
        become_like(like);
        let due = |tick| schedule.release(tick) + QUARTER * PERIOD_NS / 4;
        let mut tick = schedule.next_after(now());
        while !over.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_nanos(due(tick).saturating_sub(now())));
            port.send()?;
            tick = (tick + 1).max(schedule.next_after(now().saturating_sub(PERIOD_NS)));
        }
        Ok(())
    };
    scope.spawn(body).join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

/// The run's clock, once it runs.
fn start(run: &Run, over: &AtomicBool) -> Option<Schedule> {
    while !over.load(Ordering::Relaxed) {
        // A description that cannot be read yet is looked at again.
        if let Ok(Some(start_ns)) = run.start_ns() {
            return Some(Schedule { start_ns });
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    None
}
