use crate::LatencyError;
use crate::plots::PlotError;
use coact_run_records::RecordError;
use std::path::PathBuf;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum MonitorError {
    /// Histograms and counters.
    #[error(transparent)]
    Latency(#[from] LatencyError),
    /// A log, or the summary.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Pictures.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// Another file of the report.
    #[error("{path}: {cause}")]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
}
