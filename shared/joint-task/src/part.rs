use crate::Agent;

/// One part and where it lies at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of its kind.
    pub kind: usize,
    /// In whose workspace.
    pub workspace: Agent,
    /// Place on the table top, m.
    pub at: [f64; 2],
}
