//! The supervisor's own place among the threads of the machine.

/// Below every process of the set, above everything that is not real time: a death is noticed under load as well.
const PRIORITY: i32 = 2;

/// Puts the calling thread there, and nothing that it starts: children and other threads begin as ordinary ones.
///
/// Without the privilege it stays an ordinary thread, and notices deaths a little later on a machine under load.
pub(crate) fn stand_by() {
    // SAFETY: sets the class of the calling thread from a structure of ours.
    let refused = unsafe {
        let mut parameter = std::mem::zeroed::<libc::sched_param>();
        parameter.sched_priority = PRIORITY;
        libc::sched_setscheduler(0, libc::SCHED_FIFO | libc::SCHED_RESET_ON_FORK, &raw const parameter) != 0
    };
    if refused {
        tracing::debug!("the supervisor runs without SCHED_FIFO: {}", std::io::Error::last_os_error());
    }
}
