use serde::{Serialize, Serializer};
use std::fmt;

/// Whom a fault strikes.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Target {
    /// A process of the set.
    Process(&'static str),
    /// Two of them at once.
    Two(&'static str, &'static str),
    /// The supervisor.
    Supervisor,
    /// No process, but what all of them stand on.
    Set,
}

impl Target {
    /// The processes of the set among them.
    pub fn processes(&self) -> Vec<&'static str> {
        match self {
            Self::Process(name) => vec![name],
            Self::Two(first, second) => vec![first, second],
            Self::Supervisor | Self::Set => Vec::new(),
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Process(name) => f.write_str(name),
            Self::Two(first, second) => write!(f, "{first}+{second}"),
            Self::Supervisor => f.write_str("supervisor"),
            Self::Set => f.write_str("set"),
        }
    }
}

impl Serialize for Target {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
