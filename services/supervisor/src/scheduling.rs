//! The supervisor's own place among the threads of the machine.

use libc::{SCHED_FIFO, SCHED_OTHER, sched_param, sched_setscheduler};

/// Below every process of the set, above everything that is not real time: a death is noticed under load as well.
const PRIORITY: i32 = 2;

/// Puts the calling thread there, and whatever it starts: a replacement is wanted soon.
///
/// Without the privilege it stays an ordinary thread, and notices deaths a little later on a machine under load.
pub(crate) fn stand_by() {
    if !set(SCHED_FIFO, PRIORITY) {
        tracing::debug!("the supervisor runs without SCHED_FIFO: {}", std::io::Error::last_os_error());
    }
}

/// Makes the calling thread an ordinary one again. Async-signal-safe, as a child between fork and exec needs it.
pub(crate) fn stand_down() {
    // Refused only to a thread that never stood by, and such a one is ordinary.
    set(SCHED_OTHER, 0);
}

fn set(class: i32, priority: i32) -> bool {
    // SAFETY: all-zero is a valid value of this plain structure; the call only reads it and touches no memory.
    unsafe {
        let mut parameter: sched_param = std::mem::zeroed();
        parameter.sched_priority = priority;
        sched_setscheduler(0, class, &raw const parameter) == 0
    }
}
