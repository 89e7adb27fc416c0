//! The recorder as a process: begins a file, and follows the run to its end.

use anyhow::Context;
use coact_realtime::Process;
use coact_recorder::{Recorder, Sources, Topics, remove_recordings};
use std::time::Duration;

/// How often the topics are looked at: before the percepts, of which the fewest are kept, are too many.
const LOOK_EVERY: Duration = Duration::from_millis(2);
/// Of ordinary threads the one that listens comes first, where that is allowed: it needs little, but in time. Chosen by hand.
const NICENESS: i32 = -10;

fn main() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("recorder")?;
    let settings = process.run().settings();
    let sources = Sources::load(settings)?;
    if process.generation() == 0 {
        remove_recordings(&settings.report).context("an earlier recording cannot be removed")?;
    }
    let topics = Topics::open(process.bus(), process.pipeline(), sources.settings())?;
    process.report_ready()?;
    let Some(schedule) = process.wait_for_start()? else { return Ok(()) };
    let mut recorder = Recorder::begin(&process, schedule, sources, topics)?;
    // Only this thread's; refused, more is lost on a busy machine, and counted.
    rustix::process::setpriority_process(None, NICENESS).ok();
    let mut heartbeat = process.heartbeat()?;
    while !process.stop_requested() {
        heartbeat.beat()?;
        std::thread::sleep(LOOK_EVERY);
        recorder.look()?;
        process.warn_of_refusals();
    }
    recorder.look()?;
    recorder.finish()
}
