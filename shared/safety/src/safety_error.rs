use std::path::PathBuf;

/// Why safety limits were refused.
#[derive(Debug, thiserror::Error)]
pub enum SafetyError {
    /// The file cannot be read.
    #[error("{}: the safety limits cannot be read; expected a file such as rt-config/safety.toml", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file's contents are not the limits.
    #[error("{}:{line}: {problem}", file.display())]
    Invalid {
        /// The file.
        file: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// The key, what is wrong with it, and what was expected.
        problem: String,
    },
}
