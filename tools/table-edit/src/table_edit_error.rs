use std::path::PathBuf;

/// Why a process table was not changed.
#[derive(Debug, thiserror::Error)]
pub enum TableEditError {
    /// A file cannot be read, parsed or written.
    #[error("{}: {cause}; expected a process table, and a folder that can be written to", file.display())]
    File {
        /// Which one.
        file: PathBuf,
        /// Why.
        cause: String,
    },
    /// What is to be changed is not there: it would be added, and change nothing.
    #[error("the process table has no {0}; expected a key or a process that stands in it")]
    Missing(String),
}
