use coact_pipeline::Movement;
use std::path::PathBuf;

/// Somebody recorded, who moves the partner's hand, and how perception knows people's hands that are others'.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordedPerson {
    /// Their reaches.
    pub movement: Movement,
    /// Model of preshaping, made without them.
    pub model: PathBuf,
}
