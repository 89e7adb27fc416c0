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
    /// The raw hop's other process cannot be started or waited for.
    #[error("the raw hop's sender: {0}")]
    Sender(std::io::Error),
    /// iceoryx2 refused a port of the raw hop.
    #[error("the raw hop: {0}")]
    Port(String),
    /// The run cannot be read.
    #[error(transparent)]
    Run(#[from] coact_pipeline::RunError),
    /// The run's process table cannot be read.
    #[error(transparent)]
    Pipeline(#[from] coact_pipeline::PipelineError),
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
