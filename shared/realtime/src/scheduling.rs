//! Scheduling class and core of the calling thread: asked for, and read back as obtained.

use coact_pipeline::{Pipeline, ProcessEntry, Ready};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity, set_current_timer_slack};
use std::io;
use std::num::NonZeroU64;

/// Priority of a real-time process that is not ready yet.
const STARTING: u8 = 1;

/// Lets a process start before everything that is not real time, behind every process that is ready, and on other cores
/// than its own: a replacement is wanted soon, but locking its memory must not hold up a survivor on that core.
pub(crate) fn hurry(core: Option<usize>) {
    // Refused, it starts as any program does; what is refused for good is told when it is ready.
    let _ = fifo(STARTING);
    let mut elsewhere = sched_getaffinity(None).unwrap_or_default();
    if let Some(core) = core.filter(|&core| core < CpuSet::MAX_CPU) {
        elsewhere.unset(core);
        let _ = sched_setaffinity(None, &elsewhere);
    }
}

/// Keeps the calling thread, and all that it starts, off the cores that the table's real-time processes are pinned to,
/// where there are others: what is not real time is lent time there by the kernel, and then holds up the chain.
pub fn keep_off_real_time_cores(pipeline: &Pipeline) {
    let mut others = sched_getaffinity(None).unwrap_or_default();
    for entry in pipeline.processes.iter().filter(|entry| entry.realtime) {
        entry.core.filter(|&core| core < CpuSet::MAX_CPU).into_iter().for_each(|core| others.unset(core));
    }
    // Refused where no core is left: then it shares.
    let _ = sched_setaffinity(None, &others);
}

/// Makes the calling thread of a real-time process one that is not: ordinary class, off the real-time cores.
pub(crate) fn step_aside(pipeline: &Pipeline) {
    // SAFETY: sets the class of the calling thread from a structure of ours; to give up a class is always granted.
    unsafe {
        let parameter = std::mem::zeroed::<libc::sched_param>();
        libc::sched_setscheduler(0, libc::SCHED_OTHER, &raw const parameter);
    }
    keep_off_real_time_cores(pipeline);
}

/// Asks for what `entry` wants; returns what was refused, with the reasons.
pub(crate) fn request(entry: &ProcessEntry) -> Vec<String> {
    // Without SCHED_FIFO the kernel may delay wake-ups by this slack, 50 µs by default.
    let _ = set_current_timer_slack(NonZeroU64::new(1));
    let core = entry.core.map_or(Ok(()), pin);
    let class = if entry.realtime { fifo(entry.priority) } else { Ok(()) };
    [core, class].into_iter().filter_map(Result::err).collect()
}

/// What the calling thread has: scheduling class and priority, and its core if it has only one.
pub(crate) fn obtained(ready: &mut Ready) {
    // SAFETY: both calls only read the calling thread's attributes into a structure of ours.
    let (policy, priority) = unsafe {
        let mut parameter = std::mem::zeroed::<libc::sched_param>();
        libc::sched_getparam(0, &raw mut parameter);
        (libc::sched_getscheduler(0), parameter.sched_priority)
    };
    ready.scheduler = if policy == libc::SCHED_FIFO { "SCHED_FIFO" } else { "SCHED_OTHER" }.to_owned();
    ready.priority = u8::try_from(priority).unwrap_or(0);
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

fn fifo(priority: u8) -> Result<(), String> {
    // SAFETY: sets the class of the calling thread from a structure of ours.
    let refused = unsafe {
        let mut parameter = std::mem::zeroed::<libc::sched_param>();
        parameter.sched_priority = i32::from(priority);
        libc::sched_setscheduler(0, libc::SCHED_FIFO, &raw const parameter) != 0
    };
    match refused {
        true => Err(format!("SCHED_FIFO {priority}: {}", io::Error::last_os_error())),
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const TABLE: &str = "[[process]]\nname = \"world\"\nprogram = \"none\"\norder = 1\nrealtime = true\npriority = 7\n\
                         core = 1\ntrigger = \"timer\"\n";

    #[test]
    fn what_is_not_real_time_stays_off_the_chain_s_core_unless_there_is_no_other() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), TABLE).unwrap();
        let pipeline = Pipeline::load(file.path()).unwrap();
        let before = sched_getaffinity(None).unwrap();
        let mut expected = before;
        expected.unset(1);
        keep_off_real_time_cores(&pipeline);
        let left = if expected.count() == 0 { before } else { expected };
        assert_eq!(sched_getaffinity(None).unwrap(), left);
    }
}
