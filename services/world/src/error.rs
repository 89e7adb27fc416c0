use std::path::PathBuf;

/// Why a world could not be made.
#[derive(Debug, thiserror::Error)]
pub enum WorldError {
    /// The partner's name is none of the known ones.
    #[error(
        "partner \"{name}\" is unknown; expected synthetic, active, random, random:KEY=VALUE,..., script:FILE, recorded:DIR, recorded:FILE.mcap, left-arm:FILE, right-arm:FILE or hand"
    )]
    Partner {
        /// What was given.
        name: String,
    },
    /// A recorded run cannot be the partner.
    #[error("{message}")]
    Recording {
        /// The file, and what is wrong with it.
        message: String,
    },
    /// There can be no such partner.
    #[error(transparent)]
    Person(#[from] coact_person::PersonError),
    /// A file could not be read.
    #[error("{}: cannot be read", path.display())]
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
    /// The robot's links have no shape.
    #[error(transparent)]
    Shape(#[from] coact_robot::RobotError),
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
}
