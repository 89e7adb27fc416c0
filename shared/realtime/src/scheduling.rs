//! Scheduling class and core of the calling thread: requested, and read back as obtained.

use crate::SchedulingClass;
use coact_pipeline::{Pipeline, ProcessEntry, Ready};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity, set_current_timer_slack};
use std::num::NonZeroU64;
use std::sync::OnceLock;

/// Prepares a real-time process to start soon, because a replacement is needed at once, but not on its own core:
/// locking its memory there would delay the processes that run on that core.
pub(crate) fn prepare_start(core: Option<usize>) {
    // Refused, it starts as any program does; `apply` reports what is refused.
    let _ = SchedulingClass::STARTING.apply();
    let mut others = granted();
    if let Some(core) = core.filter(|&core| core < CpuSet::MAX_CPU) {
        others.unset(core);
        let _ = sched_setaffinity(None, &others);
    }
}

/// Keeps the calling thread, and all that it starts, off the cores of the table's real-time processes, where there are
/// others. The kernel lends ordinary threads time on such a core, and that would delay the chain.
pub fn exclude_real_time_cores(pipeline: &Pipeline) {
    let mut others = granted();
    for entry in pipeline.processes.iter().filter(|entry| entry.realtime) {
        entry.core.filter(|&core| core < CpuSet::MAX_CPU).into_iter().for_each(|core| others.unset(core));
    }
    // Refused where no core is left: the thread then shares one.
    let _ = sched_setaffinity(None, &others);
}

/// The cores that the process was started on, whichever the calling thread keeps to by now.
fn granted() -> CpuSet {
    static GRANTED: OnceLock<CpuSet> = OnceLock::new();
    *GRANTED.get_or_init(|| sched_getaffinity(None).unwrap_or_default())
}

/// Makes a thread of a real-time process an ordinary one: ordinary class, off the real-time cores.
pub(crate) fn become_ordinary(pipeline: &Pipeline) {
    // Always granted.
    let _ = SchedulingClass::Other.apply();
    exclude_real_time_cores(pipeline);
}

/// Gives the calling thread the core that `entry` wants.
///
/// # Errors
/// What was refused, with the reason.
pub(crate) fn take_core(entry: &ProcessEntry) -> Result<(), String> {
    entry.core.map_or(Ok(()), pin)
}

/// Gives the calling thread the class that `entry` wants.
///
/// # Errors
/// What was refused, with the reason.
pub(crate) fn take_class(entry: &ProcessEntry) -> Result<(), String> {
    // Without SCHED_FIFO the kernel may delay wake-ups by this slack, 50 µs by default. The least that it takes is 1 ns.
    let _ = set_current_timer_slack(NonZeroU64::new(1));
    if entry.realtime { fifo(entry.priority) } else { Ok(()) }
}

/// Writes into `ready` what the calling thread has: class and priority, and its core if it has only one.
pub(crate) fn report_obtained(ready: &mut Ready) {
    let class = SchedulingClass::current();
    ready.scheduler = class.name().to_owned();
    ready.priority = class.priority();
    let cores = sched_getaffinity(None).unwrap_or_default();
    let mut allowed = (0..CpuSet::MAX_CPU).filter(|&core| cores.is_set(core));
    ready.core = allowed.next().filter(|_| allowed.next().is_none());
}

fn pin(core: usize) -> Result<(), String> {
    let mut cores = CpuSet::new();
    if core < CpuSet::MAX_CPU {
        cores.set(core);
    }
    sched_setaffinity(None, &cores).map_err(|error| format!("core {core}: {error}"))
}

/// Keeps the calling thread, and all that it starts, to the same core as whoever does so as well.
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
pub(crate) fn keep_to_first_core() {
    let granted = granted();
    pin((0..CpuSet::MAX_CPU).find(|&core| granted.is_set(core)).unwrap()).unwrap();
}

fn fifo(priority: u8) -> Result<(), String> {
    SchedulingClass::Fifo(priority).apply().map_err(|error| format!("SCHED_FIFO {priority}: {error}"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const TABLE: &str = "[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\nrealtime = true\npriority = 7\n\
                         core = 1\ntrigger = \"timer\"\n";

    #[test]
    fn what_is_not_real_time_stays_off_the_chain_s_core_unless_there_is_no_other() {
        let pipeline = Pipeline::parse(TABLE, "table".as_ref()).unwrap();
        let before = sched_getaffinity(None).unwrap();
        let mut expected = before;
        expected.unset(1);
        exclude_real_time_cores(&pipeline);
        let left = if expected.count() == 0 { before } else { expected };
        assert_eq!(sched_getaffinity(None).unwrap(), left);
    }
}
