use std::path::PathBuf;

/// Why nothing can be learned from a file.
#[derive(Debug, thiserror::Error)]
pub enum LearnError {
    /// It cannot be read or written.
    #[error("{path}: {cause}")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// It holds something else than expected.
    #[error("{place}: {problem}")]
    Content {
        /// File, and line or entry where it is known.
        place: String,
        /// What is wrong, and what was expected.
        problem: String,
    },
    /// It is an event log that cannot be read.
    #[error(transparent)]
    Record(#[from] coact_run_records::RecordError),
    /// The network file's constants make no field.
    #[error(transparent)]
    Field(#[from] coact_neural_field::ParameterError),
}

impl LearnError {
    pub(crate) fn content(place: impl std::fmt::Display, problem: impl Into<String>) -> Self {
        Self::Content { place: place.to_string(), problem: problem.into() }
    }
}
