use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::{Flag, Slot};

/// How the person's activity differs from the plain one. All zero: carried out to its end, with a clear grip, in full
/// view, in silence and with the right hand.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub struct Variation {
    /// Cycles after grasp completion at which the activity is given up; 0: never.
    pub gives_up_after: u64,
    /// How unclearly the hand shows the grip: 0 as it should be, 1 no more than any other.
    pub blur: f64,
    /// Whether an occluder stands before the part, so that the hand at it is not seen.
    pub hidden: Flag,
    /// The phrase that is said at reach onset: index into [`says`](coact_joint_task::Chain::says) of the chain.
    pub phrase: Slot,
    /// Whether it is the left hand that acts.
    pub left: Flag,
}
