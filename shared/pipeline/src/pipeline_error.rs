use std::path::PathBuf;

/// Why a process table was refused.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// The file cannot be read. The message contains the cause, so that it is no source as well.
    #[error("{}: cannot be read: {cause}; expected a process table such as rt-config/pipeline.toml", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// The file's contents make no process table.
    #[error("{}:{line}: {key}{problem}; expected {expected}", file.display())]
    Invalid {
        /// The file.
        file: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// The key at fault with a colon and a blank behind it; empty where the file's syntax is at fault.
        key: String,
        /// What is wrong.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// No process of the table has this name.
    #[error("no process is called \"{name}\"; expected one of: {}", known.join(", "))]
    UnknownProcess {
        /// The unknown name.
        name: String,
        /// The names in the table.
        known: Vec<String>,
    },
}
