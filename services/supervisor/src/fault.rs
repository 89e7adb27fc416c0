use std::fmt;
use std::str::FromStr;

/// A fault that can be injected into a process of a running set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// SIGKILL: the process ends at once, and cannot clean up.
    Kill,
    /// SIGSTOP, then SIGCONT after [`Fault::PAUSE`]: the process hangs.
    Stop,
    /// SIGUSR1: the process's cycles overrun their period for a while.
    Slow,
    /// SIGKILL, and the next replacement is killed as well before it is ready.
    CrashOnStart,
}

impl Fault {
    /// Every fault, in the order in which messages name them.
    pub const ALL: [Self; 4] = [Self::Kill, Self::Stop, Self::Slow, Self::CrashOnStart];

    /// How long [`Fault::Stop`] stops a process. Chosen by hand: longer than the watchdog allows (500 ms), so that the
    /// process is replaced.
    pub const PAUSE: std::time::Duration = std::time::Duration::from_secs(2);

    /// The name that the command line uses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kill => "kill",
            Self::Stop => "stop",
            Self::Slow => "slow",
            Self::CrashOnStart => "crash-on-start",
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
#[error("unknown fault '{0}'; expected one of: kill, stop, slow, crash-on-start")]
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
