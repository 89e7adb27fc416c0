//! How fingers close on something that the hand encloses.

use crate::{Graspable, HAND_JOINTS, Hand};

/// Gap between an open finger and what it opens around, m. Chosen by hand: a trade-off between errors of perception and
/// the room between parts.
pub(crate) const OPEN_GAP: f64 = 0.01;
/// Step in which fingers are closed, rad: the finger ends move about half a millimetre. Chosen by hand.
const STEP: f64 = 0.005;
/// Points on each link of a finger at which its gap is measured. Chosen by hand: a few millimetres apart.
const POINTS: u32 = 16;

/// Fingers that have closed.
#[derive(Clone, Copy)]
pub(crate) struct Closure {
    /// Angle of the fingers' bases, rad.
    pub base: f64,
    /// Whether they met each other, or their limit, instead of the object.
    pub meets: bool,
}

/// Where a finger comes nearest to something, m.
#[derive(Clone, Copy)]
pub(crate) struct Nearest {
    /// Gap between them.
    pub gap: f64,
    /// Distance of that point from the palm's frame.
    pub along: f64,
}

/// The hand with the ends of all fingers `gap` m from something `width` m wide that lies across all of them.
pub(crate) fn pinching(hand: &Hand, width: f64, gap: f64) -> [f64; HAND_JOINTS] {
    let [.., middle, _, _, _] = hand.grasp(width, gap).angles;
    hand.posture(middle)
}

/// The fingers `gap` m from the object, whose middle is `depth` m in front of the palm's frame.
pub(crate) fn closed(hand: &Hand, object: &Graspable, depth: f64, gap: f64) -> Closure {
    let limit = hand.joints[1].limits.upper;
    let mut base = pinching(hand, object.width, OPEN_GAP.max(gap))[3];
    while base < limit && nearest(hand, object, depth, base).gap > gap {
        let [.., end] = hand.finger(base + STEP);
        if end[0] < hand.pad[1] && !hand.interlaces {
            return Closure { base, meets: true };
        }
        base += STEP;
    }
    Closure { base, meets: base >= limit }
}

/// Where a finger with this base angle, rad, comes nearest to the object.
pub(crate) fn nearest(hand: &Hand, object: &Graspable, depth: f64, base: f64) -> Nearest {
    let links = hand.finger(base);
    let points = links.windows(2).flat_map(|link| {
        (0..=POINTS).map(|point| {
            let fraction = f64::from(point) / f64::from(POINTS);
            let [across, along] =
                std::array::from_fn(|axis| link[0][axis] + fraction * (link[1][axis] - link[0][axis]));
            Nearest { gap: object.distance(across, along - depth) - hand.pad[1], along }
        })
    });
    let farthest = Nearest { gap: f64::INFINITY, along: 0.0 };
    points.fold(farthest, |best, point| if point.gap < best.gap { point } else { best })
}
