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
    /// How often no movement was found to where the part belongs, with it as it is held.
    pub refused: u64,
    /// Cycles for which the person has pulled at the held part.
    pub pulled: u64,
}

/// An action that was refused so often is not tried again with the part as it is held. Chosen by hand: at the first time somebody may have
/// stood in the way.
const MOST_REFUSED: u64 = 2;

impl HandState {
    /// Kind of the held part.
    pub fn held(&self) -> Option<usize> {
        self.held.get()
    }

    /// Whether nothing is held.
    pub fn is_empty(&self) -> bool {
        self.held == Slot::EMPTY
    }

    /// Whether the part must be taken otherwise before it can go where it belongs.
    pub fn is_unfit(&self) -> bool {
        self.refused >= MOST_REFUSED
    }

    pub fn check(&self) -> Result<(), Implausible> {
        self.in_palm.check("hand.in_palm")?;
        finite("hand.picked_at", &self.picked_at)
    }
}
