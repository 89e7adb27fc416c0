use coact_recordings::RecordingError;
use std::path::PathBuf;

/// Why no ways could be made out of motion capture.
#[derive(Debug, thiserror::Error)]
pub enum ExtractionError {
    /// A recording is refused.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The keyframes beside a recording are refused.
    #[error("{}: {message}", path.display())]
    Keyframes {
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        message: String,
    },
    /// The recordings show no such way.
    #[error(
        "{}: no hand {kind} in it; expected recordings in folders CollaborativeStacking, HumanRobotHandover and \
         RobotHumanHandover, each with its keyframes in a .json file beside it",
        folder.display()
    )]
    Nothing {
        /// The folder.
        folder: PathBuf,
        /// What no hand does: carries, gives, withdraws.
        kind: &'static str,
    },
}
