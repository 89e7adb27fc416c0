use std::path::PathBuf;

/// Why a model file was refused.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// It cannot be read or written.
    #[error("{path}: {reason}; make it with `coact train DIR --out {path}`", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: std::io::Error,
    },
    /// It is no model.
    #[error("{path}:{line}: {message}; make it anew with `coact train DIR --out {path}`", path = path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line, from 1; 0 where it is not known.
        line: usize,
        /// What was found and what was expected.
        message: String,
    },
}
