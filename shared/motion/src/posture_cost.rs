//! The cost of a change of posture. People end a reach in the posture that is cheapest to come to (Rosenbaum et al.,
//! Psychol. Rev. 108, 2001); the cost here is a weighted squared distance in joint space.

use coact_robot::{JointLimits, Posture};

/// Weight of each joint's squared change. Chosen by hand: the joints near the base move the whole arm and cost more than
/// the wrist's. The same for every arm of up to seven joints; untested on arms that are built very differently.
pub(crate) const WEIGHT: Posture = [1.0, 1.0, 0.8, 0.8, 0.6, 0.6, 0.4];

/// Weighted squared distance between two postures, rad².
pub(crate) fn cost(posture: &Posture, from: &Posture) -> f64 {
    (0..7).map(|joint| WEIGHT[joint] * (posture[joint] - from[joint]).powi(2)).sum()
}

/// What the weighted squared distance counts for beside the time, s/rad²: of postures that take as long to come to, the one is chosen for
/// which the other joints move little. Chosen by hand.
const BESIDES: f64 = 0.05;

/// Cost of a change of posture, s: the time of the joint that has farthest to go, at its speed limit, and a little for all of them.
pub(crate) fn time_cost(posture: &Posture, from: &Posture, limits: &[JointLimits; 7]) -> f64 {
    let times = (0..7).map(|joint| (posture[joint] - from[joint]).abs() / limits[joint].velocity);
    times.fold(0.0, f64::max) + BESIDES * cost(posture, from)
}
