use coact_recordings::{ArmSide, WayKind};
use std::ops::Range;

/// When a hand did what.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct HandPhase {
    pub hand: ArmSide,
    pub kind: WayKind,
    /// A movement belongs to the phase in which it is fastest.
    pub frames: Range<usize>,
}
