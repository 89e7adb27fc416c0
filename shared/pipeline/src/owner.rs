use serde::{Deserialize, Serialize};

/// The supervisor that owns a run: contents of `owner.json`. Whether it lives is not said here, but by the run's lock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Owner {
    /// Its process id.
    pub pid: u32,
    /// How often the run was adopted before: 0 for the supervisor that made it, one more for each successor.
    pub generation: u32,
}
