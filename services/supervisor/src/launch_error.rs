use crate::GaveUp;
use coact_messages::topic;
use coact_pipeline::{PipelineError, RunError};
use coact_realtime::PortError;
use coact_run_records::RecordError;
use std::io;
use std::path::PathBuf;

/// Why a run could not be started, or was given up.
#[derive(Debug, thiserror::Error)]
pub enum LaunchError {
    /// A program of the process table does not exist.
    #[error("process {process}: {} does not exist; build it with: cargo build --release", program.display())]
    MissingProgram {
        /// Name of the process.
        process: String,
        /// Where its program was expected.
        program: PathBuf,
    },
    /// The process table wants a standby of a stage that can have none.
    #[error("process {process}: standby = true in the process table; expected it only of {}", topic::WITH_STANDBY.join(" and "))]
    NoStandby {
        /// Name of the process.
        process: String,
    },
    /// Fewer files may be open than a run needs.
    #[error(
        "only {allowed} open files are allowed; expected {needed}: raise the hard limit (ulimit -Hn, /etc/security/limits.conf, \
         or LimitNOFILE of systemd)"
    )]
    FewOpenFiles {
        /// The hard limit.
        allowed: u64,
        /// What a run needs.
        needed: u64,
    },
    /// An injection names no process of the table.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
    /// The run directory or shared memory refuses.
    #[error(transparent)]
    Run(#[from] RunError),
    /// iceoryx2 refuses.
    #[error(transparent)]
    Port(#[from] PortError),
    /// A file of the report or the run. The message contains the cause, so that it is no source as well.
    #[error("{}: {cause}; expected a place that can be written", path.display())]
    File {
        /// The file or directory.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// A log or the summary. The message contains the cause.
    #[error("{0}; expected a place that can be written")]
    Record(RecordError),
    /// Signals cannot be handled. The message contains the cause.
    #[error("signals cannot be handled: {0}")]
    Signals(io::Error),
    /// The set was given up.
    #[error(transparent)]
    GaveUp(#[from] GaveUp),
}

impl LaunchError {
    /// True when usage, configuration or the machine is at fault, and no run has taken place.
    pub fn is_configuration(&self) -> bool {
        !matches!(self, Self::GaveUp(GaveUp { configuration: false, .. }))
    }
}
