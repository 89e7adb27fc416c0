use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// One state of a skill.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(u64)]
pub(crate) enum SkillPhase {
    /// Standing, ready for the next skill.
    Idle = 0,
    /// Waiting for a trajectory; the one under way goes on meanwhile.
    Plan = 1,
    /// Moving along the trajectory: out of where the hand is, to the goal.
    Move = 2,
    /// Waiting before the goal for the person to bring the part.
    Wait = 3,
    /// Closing the fingers.
    Close = 4,
    /// Verifying by touch and sight that a part is between them.
    Verify = 5,
    /// Standing at the goal.
    Dwell = 6,
    /// Opening the fingers.
    Open = 7,
}

impl SkillPhase {
    /// Whether a new decision must wait until this phase has ended: fingers that move are not stopped half-way.
    pub fn is_firm(self) -> bool {
        matches!(self, Self::Close | Self::Verify | Self::Open)
    }
}
