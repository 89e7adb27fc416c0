use super::StoredPose;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::{Flag, Implausible, Slot, finite};

/// What the hand holds, and how.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct HandState {
    /// Kind of the held part.
    pub held: Slot,
    /// Its frame in the palm's.
    pub in_palm: StoredPose,
    /// The grip in which the hand holds, or is about to pick, a part: index into the [grip table](crate::robot::GripTable).
    pub grip: Slot,
    /// Whether a handover is under way, in which it may touch the person's hand.
    pub hands_over: Flag,
    /// Whether the held part was picked from the table, at `picked_at`.
    pub from_table: Flag,
    /// Where the held part was when the fingers closed on it, m.
    pub picked_at: [f64; 3],
}

impl HandState {
    /// Kind of the held part.
    pub fn held(&self) -> Option<usize> {
        self.held.get()
    }

    /// Whether nothing is held.
    pub fn is_empty(&self) -> bool {
        self.held == Slot::EMPTY
    }

    pub fn check(&self) -> Result<(), Implausible> {
        self.in_palm.check("hand.in_palm")?;
        finite("hand.picked_at", &self.picked_at)
    }
}
