use crate::BenchError;
use crate::raw_port::{RawPort, become_like};
use coact_period::PERIOD_NS;
use coact_pipeline::{Pipeline, Run};
use coact_realtime::{Schedule, now};
use std::io::Read;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// When it sends, after the release: the chain rests then. In quarters of a period.
const QUARTER: u64 = 3;

/// The sending end of a [`RawHop`](crate::RawHop), in a process of its own as the chain's stages are: a switch between threads of
/// one process costs less. Sends beside the run of this directory, through iceoryx2 below `folder`, until standard input ends.
///
/// # Errors
/// [`BenchError::Port`]; the run or its process table cannot be read.
pub fn send_raw(directory: &Path, folder: &Path) -> Result<(), BenchError> {
    let run = Run::load(directory)?;
    let pipeline = Pipeline::of_run(run.settings())?;
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            // Whether it ends or fails, nobody waits for messages any more.
            std::io::stdin().read_to_end(&mut Vec::new()).ok();
            over.store(true, Ordering::Relaxed);
        });
        let port = RawPort::open(folder, true)?;
        let Some(schedule) = start(&run, &over) else { return Ok(()) };
        become_like(pipeline.processes.iter().find(|entry| entry.realtime));
        send_until(&over, &port, schedule)
    })
}

fn send_until(over: &AtomicBool, port: &RawPort, schedule: Schedule) -> Result<(), BenchError> {
    let due = |tick| schedule.release(tick) + QUARTER * PERIOD_NS / 4;
    let mut tick = schedule.next_after(now());
    while !over.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_nanos(due(tick).saturating_sub(now())));
        port.send()?;
        tick = (tick + 1).max(schedule.next_after(now().saturating_sub(PERIOD_NS)));
    }
    Ok(())
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
