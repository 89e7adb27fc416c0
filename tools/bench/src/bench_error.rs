/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The load is made by a program that is not there.
    #[error(
        "--load {0} needs stress-ng, which is not installed; expected it in PATH (apt-get install stress-ng), or --load none"
    )]
    NoStress(&'static str),
    /// The load could not be started.
    #[error("stress-ng cannot be started: {0}")]
    Load(std::io::Error),
    /// iceoryx2 refused a port of the raw hop.
    #[error("the raw hop: {0}")]
    Port(String),
    /// The process table of a bench cannot be made.
    #[error("{}: {cause}; expected a process table, and a folder that can be written to", file.display())]
    Table {
        /// What was read or written.
        file: std::path::PathBuf,
        /// Why that failed.
        cause: String,
    },
    /// The run cannot be watched.
    #[error(transparent)]
    Watch(#[from] coact_realtime::PortError),
    /// A record of the run cannot be read.
    #[error(transparent)]
    Record(#[from] coact_run_records::RecordError),
    /// A histogram of the run cannot be read.
    #[error(transparent)]
    Latency(#[from] coact_monitor::LatencyError),
}
