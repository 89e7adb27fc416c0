use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How the person's hand reaches for parts: only the world is told.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Movement {
    /// On a straight line, as smoothly as can be.
    #[default]
    MinimumJerk,
    /// As a person did who was recorded.
    Recorded {
        /// The recordings.
        folder: PathBuf,
        /// Whose.
        participant: u32,
    },
}
