use std::path::PathBuf;

/// Why there can be no such partner.
#[derive(Debug, thiserror::Error)]
pub enum PersonError {
    /// A setting of the random partner makes no sense.
    #[error("partner random: \"{entry}\"; expected {expected}")]
    Behaviour {
        /// What was given.
        entry: String,
        /// What was expected.
        expected: String,
    },
    /// How people show grips and gestures is not told as it should be.
    #[error("{place}: {message}")]
    Habits {
        /// File, and line from 1 where there is one.
        place: String,
        /// What is wrong, and what was expected.
        message: String,
    },
    /// The recordings of people's reaches cannot be read.
    #[error(transparent)]
    Recording(#[from] coact_recordings::RecordingError),
    /// The recordings can be read, but lack what the partner needs.
    #[error("{}: {message}", path.display())]
    Recordings {
        /// The folder.
        path: PathBuf,
        /// What is missing, and what is expected.
        message: String,
    },
}
