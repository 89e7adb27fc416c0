use crate::PortError;
use coact_messages::topic;
use coact_pipeline::{PipelineError, RunError};

/// Why a process ended.
#[derive(Debug, thiserror::Error)]
pub enum ProcessError {
    /// The run directory cannot be used.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The process table cannot be used.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
    /// A port failed.
    #[error(transparent)]
    Port(#[from] PortError),
    /// The process table starts the process by something else than its input.
    #[error(
        "process {process}: its trigger in the process table is {found}; expected \"timer\" or \"{expected}\""
    )]
    Trigger {
        /// The process.
        process: String,
        /// What the table says.
        found: String,
        /// The topic of the input.
        expected: String,
    },
    /// A standby of a process that can have none.
    #[error("process {process}: can have no standby; expected standby = true only of {}", topic::WITH_STANDBY.join(" and "))]
    NoStandby {
        /// The process.
        process: String,
    },
    /// The generation is no number.
    #[error("environment variable {variable}: is \"{found}\"; expected how often the process was restarted")]
    Generation {
        /// The variable.
        variable: &'static str,
        /// Its value.
        found: String,
    },
    /// No thread for background work. The message contains the cause, so that it is no source as well.
    #[error("the system grants no thread for background work: {0}; raise the limit on threads (ulimit -u)")]
    Thread(std::io::Error),
    /// The sign of life cannot be shown. The message contains the cause.
    #[error("no heartbeat can be written: {0}; expected a writable run directory")]
    Heartbeat(std::io::Error),
    /// A signal handler cannot be installed. The message contains the cause.
    #[error("signals cannot be handled: {0}; expected a system that lets a process handle SIGTERM")]
    Signals(std::io::Error),
    /// Its cycles, which were fast enough, last longer than their period, and keep others from the core.
    #[error(
        "its cycles compute for longer than their period, again and again: expected what they took before"
    )]
    Overload,
}
