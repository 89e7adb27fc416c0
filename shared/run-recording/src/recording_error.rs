use std::path::PathBuf;

/// Why a recording cannot be written or read.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// `{path}: {cause}`
    #[error("{path}: {cause}; expected a recording of a run, as coact launch --record writes it")]
    File {
        /// The recording.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// The recording cannot be written.
    #[error("{path}: cannot be written: {cause}")]
    Write {
        /// The recording.
        path: PathBuf,
        /// What the format's library says.
        cause: mcap::McapError,
    },
    /// The file is no recording of a run, or is damaged.
    #[error("{path}: {problem}; expected a recording of a run, as coact launch --record writes it")]
    Malformed {
        /// The recording.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// It holds messages that this program cannot read.
    #[error(
        "{path}: holds {message} of another layout ({found}, expected {expected}); replay it with the version of coact that recorded it"
    )]
    Layout {
        /// The recording.
        path: PathBuf,
        /// The message's type.
        message: String,
        /// Layout of the file.
        found: String,
        /// Layout of this program.
        expected: String,
    },
}
