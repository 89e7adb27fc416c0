use std::io;

/// A scheduling class of Linux, and the priority within it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SchedulingClass {
    /// SCHED_FIFO with this priority, 1 (lowest) to 99: runs before all ordinary threads.
    Fifo(u8),
    /// SCHED_OTHER: an ordinary thread.
    Other,
}

impl SchedulingClass {
    /// Of a real-time process that is not ready yet: the lowest priority of all, so that it runs before ordinary programs and behind
    /// every process that is ready.
    pub const STARTING: Self = Self::Fifo(1);

    /// Puts the calling thread, and every thread and process that it starts from then on, into this class.
    ///
    /// Async-signal-safe: it may be called between fork and exec.
    ///
    /// # Errors
    /// The system's refusal: SCHED_FIFO needs a right (`ulimit -r`). To become an ordinary thread is always granted.
    pub fn apply(self) -> io::Result<()> {
        self.apply_to(0)
    }

    /// The same for the thread with this id; 0 is the calling one.
    ///
    /// # Errors
    /// As [`SchedulingClass::apply`]; also when there is no such thread.
    pub fn apply_to(self, thread: u32) -> io::Result<()> {
        let (policy, priority) = match self {
            Self::Fifo(priority) => (libc::SCHED_FIFO, priority),
            Self::Other => (libc::SCHED_OTHER, 0),
        };
        // SAFETY: all-zero is a valid value of this plain structure, and the call only reads it.
        let status = unsafe {
            let mut parameter = std::mem::zeroed::<libc::sched_param>();
            parameter.sched_priority = i32::from(priority);
            libc::sched_setscheduler(thread.cast_signed(), policy, &raw const parameter)
        };
        if status == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
    }

    /// The class of the calling thread. Classes that coact does not use count as ordinary.
    pub fn current() -> Self {
        // SAFETY: both calls only read the calling thread's attributes into a structure of ours.
        let (policy, priority) = unsafe {
            let mut parameter = std::mem::zeroed::<libc::sched_param>();
            libc::sched_getparam(0, &raw mut parameter);
            (libc::sched_getscheduler(0), parameter.sched_priority)
        };
        match policy {
            libc::SCHED_FIFO => Self::Fifo(u8::try_from(priority).unwrap_or(0)),
            _ => Self::Other,
        }
    }

    /// The kernel's name of the class.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fifo(_) => "SCHED_FIFO",
            Self::Other => "SCHED_OTHER",
        }
    }

    /// Priority within the class; 0 for an ordinary thread.
    pub fn priority(self) -> u8 {
        match self {
            Self::Fifo(priority) => priority,
            Self::Other => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_thread_has_the_class_that_was_granted_and_may_always_give_it_up() {
        let granted = SchedulingClass::Fifo(3).apply();
        let expected = if granted.is_ok() { SchedulingClass::Fifo(3) } else { SchedulingClass::Other };
        assert_eq!(SchedulingClass::current(), expected);
        SchedulingClass::Other.apply().unwrap();
        assert_eq!(SchedulingClass::current(), SchedulingClass::Other);
    }
}
