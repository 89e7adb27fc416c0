use crate::{SegmentKind, SegmentMotion};
use coact_robot::MotionState;

/// A part of a trajectory that is being made: its kind, and the movement of all joints in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment {
    pub kind: SegmentKind,
    pub motion: SegmentMotion,
}

/// Duration of all segments, one after the other, s.
pub(crate) fn duration(segments: &[Segment]) -> f64 {
    segments.iter().map(|segment| segment.motion.duration).sum()
}

/// The end of each segment, s after the start of the first one.
pub(crate) fn ends(segments: &[Segment]) -> impl Iterator<Item = (SegmentKind, f64)> {
    segments.iter().scan(0.0, |end, segment| {
        *end += segment.motion.duration;
        Some((segment.kind, *end))
    })
}

/// The segment under way `t` s after the start of the first one, and the time since its own start, s.
pub(crate) fn during(segments: &[Segment], mut t: f64) -> Option<(&Segment, f64)> {
    for segment in segments {
        if t < segment.motion.duration {
            return Some((segment, t));
        }
        t -= segment.motion.duration;
    }
    segments.last().map(|segment| (segment, segment.motion.duration))
}

/// States of all joints `t` s after the start of the first segment.
pub(crate) fn states_at(segments: &[Segment], t: f64) -> [MotionState; 7] {
    during(segments, t).map_or([MotionState::default(); 7], |(segment, t)| segment.motion.at(t))
}
