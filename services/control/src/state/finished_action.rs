use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::{Flag, Slot};

/// An action that was carried out or given up.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct FinishedAction {
    /// Index into `Task::actions`.
    pub action: Slot,
    /// [`Decision::since`](coact_messages::Decision) of the decision for it.
    pub since: u64,
    /// Cycles since it was finished.
    pub age: u64,
    /// Whether it was given up.
    pub failed: Flag,
}
