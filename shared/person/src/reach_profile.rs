//! Time courses of a reach-to-grasp movement, as people show them.

use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

/// Median movement time of the recorded reaches, ms (715 reaches of eight people).
const MEDIAN_MS: f64 = 530.0;
/// Spread of the logarithm of movement time below the median: the recorded 5th percentile is 429 ms.
const SPREAD_BELOW: f64 = 0.129;
/// The same above the median: the recorded 95th percentile is 743 ms.
const SPREAD_ABOVE: f64 = 0.205;
/// Shortest and longest recorded movement time, ms.
const LIMITS_MS: (f64, f64) = (347.0, 895.0);

/// The hand is under way before its onset, which the recordings place where its speed has become plain: there it has
/// covered 8 % of the way, and moves with two thirds of its largest speed. This is the time before the onset, as a
/// share of movement time. So the largest speed comes early, at 35 % of movement time, and the slow phase begins at
/// 75 %, with 7 % of the way left (the recordings' medians: 10 % left at 75 %, 3 % at 90 %).
const BEFORE_ONSET: f64 = 0.3;
/// Thickness that finger and thumb add to what is between them: the keypoints are in the middle of the tips, m.
pub const FINGERS: f64 = 0.016;

/// How long before its onset a reach of `movement_time` ms begins, ms.
pub(crate) fn time_before_onset(movement_time: u64) -> u64 {
    (BEFORE_ONSET * movement_time as f64).round() as u64
}

/// Minimum jerk: fraction of a symmetric movement covered at fraction `t` of its time (Flash and Hogan 1985).
pub(crate) fn minimum_jerk(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * t * (10.0 + t * (-15.0 + 6.0 * t))
}

/// Movement time of one reach, ms.
pub(crate) fn movement_time<R: Rng>(rng: &mut R) -> u64 {
    let deviate: f64 = StandardNormal.sample(rng);
    let spread = if deviate < 0.0 { SPREAD_BELOW } else { SPREAD_ABOVE };
    (MEDIAN_MS * (spread * deviate).exp()).clamp(LIMITS_MS.0, LIMITS_MS.1).round() as u64
}

/// Largest distance of thumb and index finger on the way to a part of `width`, m: it grows by 0.8 mm with each mm
/// of width (Jeannerod 1984; Marteniuk et al. 1990), with 4 mm of scatter.
pub(crate) fn peak_aperture<R: Rng>(width: f64, rng: &mut R) -> f64 {
    let deviate: f64 = StandardNormal.sample(rng);
    (0.040 + 0.8 * width + 0.004 * deviate.clamp(-2.5, 2.5)).max(width + 0.01) + FINGERS
}

/// Fraction of the movement, from its very beginning, at which the aperture is largest: two thirds of movement time.
pub(crate) fn peak_time<R: Rng>(rng: &mut R) -> f64 {
    let of_movement_time = 0.67 + 0.04 * (rng.random::<f64>() - 0.5);
    (BEFORE_ONSET + of_movement_time) / (BEFORE_ONSET + 1.0)
}
