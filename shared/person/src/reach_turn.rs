use crate::HandMovement;
use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, Slot, ensure};

/// How the present reach has turned to another part than the one for which the hand set out, if it has.
///
/// [`PersonState::movement`](crate::PersonState::movement) then is the second movement. The first one goes on beside it, and the
/// hand follows both at once.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct ReachTurn {
    /// Tick at which the second movement began; 0: the reach has not turned.
    pub begun: u64,
    /// First tick from which on, for 50 ms at least, the hand moved more in the direction of the new part than in that of the old one;
    /// 0: not yet. Before the 50 ms are over it may be 0 again.
    pub headed: u64,
    /// The first movement, as it was when the second one began.
    pub(crate) first: HandMovement,
    /// Recorded reach that drives the first movement.
    pub(crate) recording: Slot,
}

impl ReachTurn {
    /// The first movement of a reach that has turned.
    pub(crate) fn first(&self) -> Option<&HandMovement> {
        (self.begun > 0).then_some(&self.first)
    }

    /// Refuses what cannot be at tick `now` with so many recorded reaches.
    pub(crate) fn check(&self, recordings: usize, now: u64) -> Result<(), Implausible> {
        let been = self.begun <= now.max(1) && self.headed <= now.max(1);
        ensure(been, "person.turn", "ticks that have been")?;
        ensure(self.recording.is_below(recordings), "person.turn.recording", "one that there is")?;
        self.first.check()
    }
}
