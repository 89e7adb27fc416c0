use coact_period::PERIOD;
use std::time::Duration;

/// A fault that a process does to itself when a signal requests it: what nobody can do to it from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RequestedFault {
    /// Its main thread panics.
    Panic,
    /// It ends with exit status 0, as if its work were done.
    ExitSuccess,
    /// It ends with exit status 1.
    ExitFailure,
    /// Its cycles take half a period longer for a while.
    SlowByHalf,
    /// Its cycles take two periods longer for a while: each misses its deadline, and skips a cycle.
    Slow,
    /// Its cycles take five periods longer for a while.
    SlowByFive,
    /// Its planner stands still.
    FreezePlanner,
}

impl RequestedFault {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Panic,
        Self::ExitSuccess,
        Self::ExitFailure,
        Self::SlowByHalf,
        Self::Slow,
        Self::SlowByFive,
        Self::FreezePlanner,
    ];

    /// The signal that requests it: real-time signals, which nothing else of ours uses. The first stays free for debuggers
    /// and tools such as valgrind.
    pub fn signal(self) -> i32 {
        libc::SIGRTMIN() + 1 + self as i32
    }

    /// By how much each of the next cycles takes longer; none where the process ends, or its cycles are not concerned.
    pub(crate) fn slowdown(self) -> Option<Duration> {
        match self {
            Self::Panic | Self::ExitSuccess | Self::ExitFailure | Self::FreezePlanner => None,
            Self::SlowByHalf => Some(PERIOD / 2),
            Self::Slow => Some(PERIOD * 2),
            Self::SlowByFive => Some(PERIOD * 5),
        }
    }

    /// Ends the process as requested; returns where the process is to live on.
    pub(crate) fn end(self) {
        match self {
            Self::Panic => panic!("injected fault: panic"),
            Self::ExitSuccess => std::process::exit(0),
            Self::ExitFailure => std::process::exit(1),
            Self::SlowByHalf | Self::Slow | Self::SlowByFive | Self::FreezePlanner => {}
        }
    }
}
