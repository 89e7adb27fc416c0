/// The kinds of a trajectory's segments, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SegmentKind {
    /// Straight back from where the hand is.
    Leave,
    /// To the goal or, where the hand approaches it, to the pose before it.
    Reach,
    /// To the goal from the pose before it.
    Approach,
}

impl SegmentKind {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Leave, Self::Reach, Self::Approach];
}
