use coact_realtime::RequestedFault;
use rustix::process::Signal;
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

/// A fault that can be injected into a process of a running set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Fault {
    /// SIGKILL: the process ends at once, and cannot clean up.
    Kill,
    /// SIGSTOP, then SIGCONT after two seconds: longer than any watchdog allows.
    Stop,
    /// SIGSTOP, then SIGCONT after 50 ms.
    StopShort,
    /// SIGSTOP, and no SIGCONT.
    StopForGood,
    /// Its main thread waits for what never comes.
    Block,
    /// SIGABRT: the process ends as by `abort`.
    Abort,
    /// Its main thread panics.
    Panic,
    /// It ends with exit status 0.
    ExitSuccess,
    /// It ends with exit status 1.
    ExitFailure,
    /// Its cycles take half a period longer for a while.
    SlowByHalf,
    /// Its cycles overrun their period for a while, by two periods.
    Slow,
    /// The same by five.
    SlowByFive,
    /// SIGKILL, and the next replacement is killed as well before it is ready.
    CrashOnStart,
    /// SIGKILL, and every replacement is killed before it is ready.
    CrashLoop,
    /// SIGKILL, and the next replacement stands still before it is ready.
    StuckOnStart,
    /// Its planner, a thread of its own, stands still from its next query on.
    FreezePlanner,
    /// SIGKILL, and what it left for its replacement is spoiled.
    PoisonedResume,
    /// Its cameras show nothing for 0.1 s.
    DropOutShort,
    /// Its cameras show nothing for a second.
    DropOut,
    /// Its cameras show nothing for ten seconds.
    DropOutLong,
    /// It gets no file handles any more.
    NoHandles,
}

/// By what a fault is injected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Means {
    /// A signal that the process cannot resist.
    Signal(Signal),
    /// SIGSTOP, and SIGCONT after this time.
    Pause(Duration),
    /// The process does it to itself.
    Request(RequestedFault),
    /// The kernel grants it no file handles from now on.
    NoHandles,
}

impl Fault {
    /// Every fault, in the order in which messages name them.
    pub const ALL: [Self; 21] = [
        Self::Kill,
        Self::Stop,
        Self::StopShort,
        Self::StopForGood,
        Self::Block,
        Self::Abort,
        Self::Panic,
        Self::ExitSuccess,
        Self::ExitFailure,
        Self::SlowByHalf,
        Self::Slow,
        Self::SlowByFive,
        Self::CrashOnStart,
        Self::CrashLoop,
        Self::StuckOnStart,
        Self::FreezePlanner,
        Self::PoisonedResume,
        Self::DropOutShort,
        Self::DropOut,
        Self::DropOutLong,
        Self::NoHandles,
    ];

    /// The name that the command line uses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kill => "kill",
            Self::Stop => "stop",
            Self::StopShort => "stop-50ms",
            Self::StopForGood => "stop-for-good",
            Self::Block => "block",
            Self::Abort => "abort",
            Self::Panic => "panic",
            Self::ExitSuccess => "exit-0",
            Self::ExitFailure => "exit-1",
            Self::SlowByHalf => "slow-half",
            Self::Slow => "slow",
            Self::SlowByFive => "slow-five",
            Self::CrashOnStart => "crash-on-start",
            Self::CrashLoop => "crash-loop",
            Self::StuckOnStart => "stuck-on-start",
            Self::FreezePlanner => "freeze-planner",
            Self::PoisonedResume => "poisoned-resume",
            Self::DropOutShort => "drop-out-100ms",
            Self::DropOut => "drop-out-1s",
            Self::DropOutLong => "drop-out-10s",
            Self::NoHandles => "no-handles",
        }
    }

    /// What it does, in a few words.
    pub fn description(self) -> &'static str {
        match self {
            Self::Kill => "SIGKILL",
            Self::Stop => "stands still for two seconds, or until it is replaced as hung",
            Self::StopShort => "stands still for 50 ms, or until it is replaced as hung",
            Self::StopForGood => "stands still until it is replaced as hung",
            Self::Block => "waits for what never comes, until it is replaced as hung",
            Self::Abort => "SIGABRT",
            Self::Panic => "its main thread panics",
            Self::ExitSuccess => "ends with exit status 0",
            Self::ExitFailure => "ends with exit status 1",
            Self::SlowByHalf => "its cycles take half a period longer for a while",
            Self::Slow => "its cycles overrun for a while, by two periods",
            Self::SlowByFive => "the same by five periods",
            Self::CrashOnStart => "SIGKILL, and once more while its replacement starts",
            Self::CrashLoop => "SIGKILL, and again while each replacement starts",
            Self::StuckOnStart => "SIGKILL, and its replacement stands still while it starts",
            Self::FreezePlanner => "of control: its planner stands still from the next query on",
            Self::PoisonedResume => "SIGKILL, and what it left for its replacement is spoiled",
            Self::DropOutShort => "of world: its cameras show nothing for 0.1 s",
            Self::DropOut => "of world: its cameras show nothing for a second",
            Self::DropOutLong => "of world: its cameras show nothing for ten seconds",
            Self::NoHandles => "it gets no file handles any more",
        }
    }

    pub(crate) fn means(self) -> Means {
        match self {
            Self::Kill | Self::CrashOnStart | Self::CrashLoop | Self::StuckOnStart | Self::PoisonedResume => {
                Means::Signal(Signal::KILL)
            }
            Self::Abort => Means::Signal(Signal::ABORT),
            Self::StopForGood => Means::Signal(Signal::STOP),
            Self::Stop => Means::Pause(Duration::from_secs(2)),
            Self::StopShort => Means::Pause(Duration::from_millis(50)),
            Self::Block => Means::Request(RequestedFault::Block),
            Self::Panic => Means::Request(RequestedFault::Panic),
            Self::ExitSuccess => Means::Request(RequestedFault::ExitSuccess),
            Self::ExitFailure => Means::Request(RequestedFault::ExitFailure),
            Self::SlowByHalf => Means::Request(RequestedFault::SlowByHalf),
            Self::Slow => Means::Request(RequestedFault::Slow),
            Self::SlowByFive => Means::Request(RequestedFault::SlowByFive),
            Self::FreezePlanner => Means::Request(RequestedFault::FreezePlanner),
            Self::DropOutShort => Means::Request(RequestedFault::DropOutShort),
            Self::DropOut => Means::Request(RequestedFault::DropOut),
            Self::DropOutLong => Means::Request(RequestedFault::DropOutLong),
            Self::NoHandles => Means::NoHandles,
        }
    }

    /// The only process to which it can be done; none when it can be done to each.
    pub fn only_of(self) -> Option<&'static str> {
        match self {
            Self::FreezePlanner => Some("control"),
            _ => self.drop_out().map(|_| "world"),
        }
    }

    /// Whether it takes effect later, when what it breaks is needed.
    pub(crate) fn is_latent(self) -> bool {
        matches!(self, Self::FreezePlanner | Self::NoHandles)
    }

    /// Whether the process does not live on after it; where it may, the watchdog decides.
    pub(crate) fn is_recovered_from_by_a_replacement(self) -> bool {
        let goes_on = matches!(self, Self::SlowByHalf | Self::Slow | Self::SlowByFive | Self::NoHandles);
        !goes_on && self.drop_out().is_none()
    }

    /// For how long the cameras show nothing; none where it is something else.
    pub fn drop_out(self) -> Option<Duration> {
        match self.means() {
            Means::Request(requested) => requested.drop_out(),
            _ => None,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// No such fault.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown fault '{}'; expected one of: {}", .0, Fault::ALL.map(Fault::name).join(", "))]
pub struct UnknownFault(pub String);

impl FromStr for Fault {
    type Err = UnknownFault;

    fn from_str(text: &str) -> Result<Self, UnknownFault> {
        Self::ALL.into_iter().find(|fault| fault.name() == text).ok_or_else(|| UnknownFault(text.into()))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn every_fault_is_read_back_from_its_name_and_the_error_names_them_all() {
        let error = Fault::from_str("explode").unwrap_err().to_string();
        for fault in Fault::ALL {
            assert_eq!(fault.name().parse(), Ok(fault));
            assert!(error.contains(fault.name()), "{error}");
        }
    }
}
