use std::path::PathBuf;

/// Why a record could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file could not be read or written.
    #[error("{path}: {cause}")]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// A line is none of this log's.
    #[error(
        "{path}:{line}: not a line of this log: {cause}; the file is damaged or of another version: move the report \
         away or name another one"
    )]
    Line {
        /// Of the log.
        path: PathBuf,
        /// Where, counted from 1.
        line: usize,
        /// What is wrong with it.
        cause: serde_json::Error,
    },
    /// The file is no summary.
    #[error("{path}: not a summary of a run: {cause}; the file is damaged or of another version")]
    Summary {
        /// Of the summary.
        path: PathBuf,
        /// What is wrong with it, and where.
        cause: serde_json::Error,
    },
}
