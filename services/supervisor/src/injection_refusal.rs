/// Why a fault was not injected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum InjectionRefusal {
    /// The set has no process of this name.
    #[error("unknown process '{name}'; this set has: {}", .known.join(", "))]
    UnknownProcess {
        /// The name that was given.
        name: String,
        /// The names that there are.
        known: Vec<String>,
    },
    /// The fault cannot be done to this process.
    #[error("{fault} cannot be done to {process}; expected {only}")]
    OtherProcess {
        /// The fault.
        fault: crate::Fault,
        /// The process that was named.
        process: String,
        /// The one to which it can be done.
        only: &'static str,
    },
    /// It is starting or being restarted.
    #[error("{0} is not running just now: it is being started; try again")]
    NotRunning(String),
}
