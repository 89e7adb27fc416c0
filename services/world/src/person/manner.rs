use crate::slot::Slot;
use bytemuck::{Pod, Zeroable};

/// How the person carries out an action. All zero: to the end, clearly, in full view and in silence.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub(crate) struct Manner {
    /// Ticks after grasp completion at which the action is given up; 0: never.
    pub gives_up: u64,
    /// How unclearly the hand shows the grip: 0 as it should be, 1 no more than any other.
    pub blur: f64,
    /// 1: something stands before the part, so that the hand at it is not seen.
    pub hidden: u64,
    /// The phrase that is said at reach onset: index into [`says`](coact_joint_task::Chain::says) of the chain.
    pub phrase: Slot,
}
