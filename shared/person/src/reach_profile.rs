//! Time courses of a reach-to-grasp movement, as people show them.

use coact_period::cycles;
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};
use std::time::Duration;

/// Median movement time of the recorded reaches, cycles (715 reaches of eight people, Dagioglou et al. 2022).
const MEDIAN: f64 = cycles(Duration::from_millis(530)) as f64;
/// Spread of the logarithm of movement time below the median: the recorded 5th percentile is 429 ms.
const SPREAD_BELOW: f64 = 0.129;
/// The same above the median: the recorded 95th percentile is 743 ms.
const SPREAD_ABOVE: f64 = 0.205;
/// Shortest and longest recorded movement time, cycles.
const SHORTEST: f64 = cycles(Duration::from_millis(347)) as f64;
const LONGEST: f64 = cycles(Duration::from_millis(895)) as f64;

/// Time from the very beginning of a reach to its onset, as a fraction of movement time: the recordings put the onset
/// where the hand's speed has become plain. This profile then has covered 8 % of its path, at two thirds of its largest
/// speed; it is fastest at 35 % of movement time, and slow from 75 % on, with 7 % of the path left. The recordings'
/// medians: 10 % left at 75 %, 3 % at 90 %. Recorded hands have covered 18 to 21 % at their onset (median of 530 reaches),
/// and brake for longer: in that a profile of minimum jerk is not theirs.
const BEFORE_ONSET: f64 = 0.3;
/// Thickness that finger and thumb add to what is between them, m: the keypoints are in the middle of the tips, each some
/// 8 mm thick to either side.
pub const FINGERS: f64 = 0.016;

/// How long before its onset a reach of `movement_time` cycles begins, cycles.
pub(crate) fn time_before_onset(movement_time: u64) -> u64 {
    (BEFORE_ONSET * movement_time as f64).round() as u64
}

/// Minimum jerk: fraction of a symmetric movement covered at fraction `t` of its time (Flash and Hogan 1985).
pub(crate) fn minimum_jerk(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * t * (10.0 + t * (-15.0 + 6.0 * t))
}

/// Movement time of one reach, cycles.
pub(crate) fn movement_time<R: Rng>(rng: &mut R) -> u64 {
    let deviate: f64 = StandardNormal.sample(rng);
    let spread = if deviate < 0.0 { SPREAD_BELOW } else { SPREAD_ABOVE };
    (MEDIAN * (spread * deviate).exp()).clamp(SHORTEST, LONGEST).round() as u64
}

/// Largest distance of thumb and index finger towards a part of `width`, m: it grows by 0.8 mm with each mm
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
