use super::FinishedAction;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::Slot;

/// What the decisions were, and what has become of them.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct DecisionState {
    /// Cycles without any decision.
    pub silent: u64,
    /// Cycles for which a part has been held without any decision.
    pub unneeded: u64,
    /// The action that was carried out, or given up, last: it is not repeated for the same decision.
    pub finished: FinishedAction,
    /// Grasps in a row that closed on nothing.
    pub misses: u64,
    /// Cycle in which the present decision was first seen; empty once its movement has begun.
    pub decided: Slot,
    /// Movements that decisions have begun so far.
    pub begun: u64,
    /// How many cycles after its decision the last of them began.
    pub reaction: u64,
}

impl DecisionState {
    /// Notes that a decision is acted upon.
    pub fn note_decision(&mut self, tick: u64) {
        self.decided = Slot::of(tick as usize);
    }

    /// Notes that a movement begins: the decision's, if that had none yet.
    pub fn note_movement(&mut self, tick: u64) {
        if let Some(decided) = std::mem::take(&mut self.decided).get() {
            self.reaction = tick.saturating_sub(decided as u64);
            self.begun = self.begun.wrapping_add(1);
        }
    }
}
