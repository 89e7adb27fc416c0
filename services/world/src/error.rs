use std::path::PathBuf;

/// Why a world could not be made.
#[derive(Debug, thiserror::Error)]
pub enum WorldError {
    /// The partner's name is none of the known ones.
    #[error(
        "partner \"{name}\" is unknown; expected synthetic, random, random:KEY=VALUE,..., script:FILE or recorded:DIR"
    )]
    Partner {
        /// What was given.
        name: String,
    },
    /// A rate of the erring partner makes no sense.
    #[error("partner random: \"{entry}\"; expected {expected}")]
    Rate {
        /// What was given.
        entry: String,
        /// What was expected.
        expected: String,
    },
    /// A file could not be read.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A scenario is not as it should be.
    #[error("{}:{line}: {message}", path.display())]
    Scenario {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Key, what was found and what was expected.
        message: String,
    },
    /// The scene cannot be simulated as it is laid out.
    #[error("task \"{task}\": {message}")]
    Scene {
        /// The task's name.
        task: String,
        /// What is wrong, and what to change.
        message: String,
    },
    /// The robot cannot be simulated as its files describe it.
    #[error("robot joint \"{joint}\" {message}")]
    Robot {
        /// The joint's name in the URDF.
        joint: String,
        /// What is wrong, and what to change.
        message: String,
    },
    /// The recordings of people's reaches cannot be used.
    #[error(transparent)]
    Recording(#[from] coact_recordings::RecordingError),
    /// The recordings lack what the task needs.
    #[error("{}: {message}", path.display())]
    Recordings {
        /// The folder.
        path: PathBuf,
        /// What is missing, and what is expected.
        message: String,
    },
}
