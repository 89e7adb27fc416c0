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
    #[error("{path}: no .csv file in it; expected one for each person, e.g. p1.csv", path = path.display())]
    Empty {
        /// The folder.
        path: PathBuf,
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
}
