use crate::hand::HandMemory;
use crate::hiding::Hiding;
use crate::loss::Loss;
use crate::objects::ObjectsMemory;
use crate::preshape::PreshapeMemory;
use bytemuck::{Pod, Zeroable};
use coact_messages::PerceptionMemory;

/// Layout of [`PerceptionMemory::word`]: everything that perception must remember and that no other field of the
/// percept holds. Words behind it are zero.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Memory {
    /// The tracked hand and its present movement.
    pub hand: HandMemory,
    /// The present reach's features, and what is known of this person's hand.
    pub preshape: PreshapeMemory,
    /// Every part that has been sighted.
    pub objects: ObjectsMemory,
    /// A hand that has gone out of sight.
    pub hiding: Hiding,
    /// A part that has gone out of the robot's hand.
    pub loss: Loss,
    /// Cycles that the hand has lain at rest, or that nothing has been seen of it for long.
    pub dwell: u64,
    /// Cycles that nothing has been seen of the hand.
    pub unseen: u64,
    /// Pitch of the hand when it took what it holds, rad; of the empty hand, its pitch now.
    grip_pitch: f64,
    /// 1 if that pitch could be seen.
    grip_seen: u64,
}

const _: () = assert!(size_of::<Memory>() <= size_of::<PerceptionMemory>());

impl Memory {
    /// Pitch of the hand when it took what it holds, rad; `None` if it could not be seen.
    pub fn grip_pitch(&self) -> Option<f64> {
        (self.grip_seen == 1).then_some(self.grip_pitch)
    }

    /// Keeps the pitch of an empty hand.
    pub fn keep_pitch(&mut self, pitch: Option<f64>) {
        self.grip_seen = u64::from(pitch.is_some());
        self.grip_pitch = pitch.unwrap_or(0.0);
    }

    /// The memory that lies in a percept's words.
    pub fn of(words: &PerceptionMemory) -> &Self {
        bytemuck::from_bytes(&bytemuck::bytes_of(words)[..size_of::<Self>()])
    }

    /// The same, to be written.
    pub fn of_mut(words: &mut PerceptionMemory) -> &mut Self {
        bytemuck::from_bytes_mut(&mut bytemuck::bytes_of_mut(words)[..size_of::<Self>()])
    }
}
