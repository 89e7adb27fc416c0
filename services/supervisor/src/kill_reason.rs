use std::fmt;
use std::time::Duration;

/// Why the supervisor killed a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum KillReason {
    /// An injected fault, before it was ready.
    InjectedCrash,
    /// It was not ready within this time.
    NotReadyInTime(Duration),
    /// It published no pulse for more than this time.
    Hung(Duration),
    /// It showed no sign of life for more than this time.
    NoHeartbeat(Duration),
    /// It did not end within this time after SIGTERM.
    DidNotStop(Duration),
}

impl fmt::Display for KillReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InjectedCrash => write!(f, "killed before it was ready, by an injected fault"),
            Self::NotReadyInTime(limit) => write!(f, "not ready within {} s", limit.as_secs_f64()),
            Self::Hung(limit) => write!(f, "hung: no pulse for more than {} ms", limit.as_millis()),
            Self::NoHeartbeat(limit) => {
                write!(f, "hung: no heartbeat for more than {} ms", limit.as_millis())
            }
            Self::DidNotStop(limit) => write!(f, "killed: it did not end within {} s", limit.as_secs_f64()),
        }
    }
}
