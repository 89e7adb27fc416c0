use crate::Fault;

/// What is done to a replacement before it is ready.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StartFault {
    /// It is killed.
    Crash,
    /// It is killed, and so is every one after it.
    CrashLoop,
    /// It is stopped, and never continued.
    Stuck,
}

impl StartFault {
    /// What follows when this fault was injected into the predecessor.
    pub(crate) fn after(fault: Fault) -> Option<Self> {
        match fault {
            Fault::CrashOnStart => Some(Self::Crash),
            Fault::CrashLoop => Some(Self::CrashLoop),
            Fault::StuckOnStart => Some(Self::Stuck),
            _ => None,
        }
    }

    /// Whether it is done to the replacements after the next one as well.
    pub(crate) fn is_repeated(self) -> bool {
        self == Self::CrashLoop
    }
}
