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
    /// It is starting or being restarted.
    #[error("{0} is not running just now: it is being started; try again")]
    NotRunning(String),
}
