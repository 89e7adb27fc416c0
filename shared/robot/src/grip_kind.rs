/// What of the hand holds something (Napier, J. Bone Joint Surg. 38-B, 1956: precision and power grip).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripKind {
    /// The ends of the fingers.
    Precision,
    /// The fingers around it, deep in the hand: it cannot get out towards their ends.
    WholeHand,
}
