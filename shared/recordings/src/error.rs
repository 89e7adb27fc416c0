use crate::ArmSide;
use std::path::PathBuf;

/// Why a recording was refused.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// A folder or file cannot be read.
    #[error("{path}: {reason}", path = path.display())]
    Io {
        /// Folder or file.
        path: PathBuf,
        /// What the operating system said.
        reason: std::io::Error,
    },
    /// The folder holds no recording.
    #[error("{path}: no recording in it; expected one file for each person, e.g. p1.csv or p1.csv.gz", path = path.display())]
    Empty {
        /// The folder.
        path: PathBuf,
    },
    /// The same recording stands in the folder with and without compression.
    #[error("{path}: stands beside {other}; expected one of them only", path = path.display(), other = other.display())]
    Twice {
        /// One file.
        path: PathBuf,
        /// The other one.
        other: PathBuf,
    },
    /// A file holds more text than any recording should.
    #[error("{path}: holds more than {limit} bytes of text; expected the recording of one person", path = path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// How much is read at most, bytes.
        limit: u64,
    },
    /// A column is missing.
    #[error("{path}:1: column \"{column}\" is missing; expected {expected}", path = path.display())]
    Column {
        /// The file.
        path: PathBuf,
        /// Its name.
        column: String,
        /// What it would hold.
        expected: &'static str,
    },
    /// A line cannot be used.
    #[error("{path}:{line}: {message}", path = path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// What was found and what was expected.
        message: String,
    },
    /// An arm was nowhere recorded for long enough.
    #[error(
        "{path}: the {side} arm is nowhere recorded for {shortest} s without a break; expected shoulder, elbow and hand, seen together",
        path = path.display(), side = side.name()
    )]
    Unseen {
        /// The file.
        path: PathBuf,
        /// Which arm.
        side: ArmSide,
        /// How long it must be, s.
        shortest: f64,
    },
    /// There is no motion capture in the folder.
    #[error("{path}: no .csv file in it, nor in a folder in it; expected motion capture, one file for each recording", path = path.display())]
    NoArms {
        /// The folder.
        path: PathBuf,
    },
}

impl RecordingError {
    /// Whether the recording is sound, and only shows an arm for too short a time.
    pub fn is_unseen(&self) -> bool {
        matches!(self, Self::Unseen { .. })
    }
}
