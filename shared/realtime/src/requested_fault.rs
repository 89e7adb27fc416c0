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
    /// Its cameras show nothing for 0.1 s.
    DropOutShort,
    /// Its cameras show nothing for a second.
    DropOut,
    /// Its cameras show nothing for ten seconds.
    DropOutLong,
    /// Its main thread waits for what never comes.
    Block,
}

impl RequestedFault {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Panic,
        Self::ExitSuccess,
        Self::ExitFailure,
        Self::SlowByHalf,
        Self::Slow,
        Self::SlowByFive,
        Self::FreezePlanner,
        Self::DropOutShort,
        Self::DropOut,
        Self::DropOutLong,
        Self::Block,
    ];

    /// The fault of this number; 0 is none.
    pub(crate) fn numbered(number: usize) -> Option<Self> {
        Self::ALL.get(number.wrapping_sub(1)).copied()
    }

    /// The signal that requests it: real-time signals, which nothing else of ours uses. The first stays free for debuggers
    /// and tools such as valgrind.
    pub fn signal(self) -> i32 {
        libc::SIGRTMIN() + 1 + self as i32
    }

    /// By how much each of the next cycles takes longer; none where the process ends, or its cycles are not concerned.
    pub(crate) fn slowdown(self) -> Option<Duration> {
        match self {
            Self::SlowByHalf => Some(PERIOD / 2),
            Self::Slow => Some(PERIOD * 2),
            Self::SlowByFive => Some(PERIOD * 5),
            _ => None,
        }
    }

    /// For how long its cameras show nothing; none where it is something else.
    pub fn drop_out(self) -> Option<Duration> {
        match self {
            Self::DropOutShort => Some(Duration::from_millis(100)),
            Self::DropOut => Some(Duration::from_secs(1)),
            Self::DropOutLong => Some(Duration::from_secs(10)),
            _ => None,
        }
    }

    /// Ends the process as requested, or its thread's work; returns where that is to go on.
    pub(crate) fn end(self) {
        match self {
            Self::Block => loop {
                std::thread::park();
            },
            Self::Panic => panic!("injected fault: panic"),
            Self::ExitSuccess => std::process::exit(0),
            Self::ExitFailure => std::process::exit(1),
            _ => {}
        }
    }
}
