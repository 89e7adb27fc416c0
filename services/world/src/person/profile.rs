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

/// Fraction of the path covered at fraction `t` of movement time, both in [0, 1].
///
/// Speed goes with t² (1 - t)³: it peaks at 40 % of movement time, and from 75 % on, the slow phase, less than 4 %
/// of the path remain. Speed and acceleration are zero at both ends.
pub(crate) fn reach_progress(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * t * (20.0 + t * (-45.0 + t * (36.0 - 10.0 * t)))
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
    (0.040 + 0.8 * width + 0.004 * deviate.clamp(-2.5, 2.5)).max(width + 0.01)
}

/// Fraction of movement time at which the aperture is largest: about two thirds.
pub(crate) fn peak_time<R: Rng>(rng: &mut R) -> f64 {
    0.67 + 0.04 * (rng.random::<f64>() - 0.5)
}
