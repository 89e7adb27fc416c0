use crate::{SegmentKind, SegmentMotion};

/// One segment of a movement in the making.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment {
    /// Which.
    pub kind: SegmentKind,
    /// Its movement.
    pub motion: SegmentMotion,
}
