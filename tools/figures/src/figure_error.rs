use std::path::PathBuf;

/// Why figures could not be made.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant's message says it")]
pub enum FigureError {
    #[error("figure {number} is unknown; expected some of {known}")]
    Unknown { number: u32, known: String },
    #[error("{path}: {cause}; expected a folder that can be written to")]
    Folder { path: PathBuf, cause: std::io::Error },
    #[error(transparent)]
    Stage(#[from] coact_lockstep::LockstepError),
    #[error(transparent)]
    Field(#[from] coact_neural_field::ParameterError),
    #[error(transparent)]
    Drawing(#[from] coact_drawing::DrawingError),
}
