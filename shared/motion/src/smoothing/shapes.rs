//! The shapes in which a movement may be changed: the bounce of the reach and, where the waypoints are free, the quintics
//! that change position, velocity and acceleration at each of them.

use crate::segment_motion::bounce_profile;
use crate::{Segment, SegmentKind};
use coact_robot::{MotionState, Quintic};

/// How many shapes there are.
pub(super) fn count(segments: &[Segment], is_free: bool) -> usize {
    1 + if is_free { 3 * (segments.len() - 1) } else { 0 }
}

/// The values of so many shapes `t` s after the start of the segment `index`, all segments taking `total` s. A waypoint's
/// position may change between two reaches, and where `is_moved` says so.
pub(super) fn values(
    segments: &[Segment],
    count: usize,
    (index, t, total): (usize, f64, f64),
    is_moved: &dyn Fn(usize) -> bool,
) -> Vec<f64> {
    let Segment { kind, motion } = &segments[index];
    let own = motion.duration / total;
    let [bounce, ..] = bounce_profile((t / motion.duration).min(1.0));
    let mut values = vec![if *kind == SegmentKind::Reach { bounce } else { 0.0 }];
    let is_between_reaches = |waypoint: usize| {
        (waypoint..waypoint + 2).all(|segment| segments[segment].kind == SegmentKind::Reach)
    };
    values.extend((1..count).map(|shape| {
        let (waypoint, order) = ((shape - 1) / 3, (shape - 1) % 3);
        let of = |which: usize| if order == which { 1.0 } else { 0.0 };
        let position = if is_between_reaches(waypoint) || is_moved(waypoint) { of(0) } else { 0.0 };
        let moved = MotionState { position, velocity: of(1), acceleration: of(2) };
        let rest = MotionState::default();
        match index {
            before if before == waypoint => Quintic::new(rest, moved, own).at(t / total).position,
            after if after == waypoint + 1 => Quintic::new(moved, rest, own).at(t / total).position,
            _ => 0.0,
        }
    }));
    values
}
