use crate::Trajectory;

/// One stage of a movement in the making.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stage {
    /// Which.
    pub kind: StageKind,
    /// Its movement.
    pub trajectory: Trajectory,
}

/// Stages of a movement, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StageKind {
    /// Back from where the hand is.
    Leave,
    /// To the goal, or to the pose before it.
    Reach,
    /// To the goal from the pose before it.
    Approach,
}

impl StageKind {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Leave, Self::Reach, Self::Approach];
}
