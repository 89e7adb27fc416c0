use crate::Cell;
use serde::Serialize;

/// What became of a cell.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "outcome", content = "reasons", rename_all = "lowercase")]
pub enum Outcome {
    /// Every rule was kept.
    Green,
    /// Rules were broken: one sentence for each.
    Red(Vec<String>),
    /// The robot did its work safely, and this machine took longer than allowed to recover: one sentence for each.
    Late(Vec<String>),
    /// Nobody can say: why.
    Unknown(String),
}

/// A cell, and what became of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct JudgedCell {
    /// The cell.
    #[serde(flatten)]
    pub cell: Cell,
    /// What became of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}
