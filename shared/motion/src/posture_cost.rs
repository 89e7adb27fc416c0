//! The cost of a change of posture. People end a reach in the posture that is cheapest to come to (Rosenbaum et al.,
//! Psychol. Rev. 108, 2001); the cost here is a weighted squared distance in joint space.

use coact_robot::Posture;

/// Weight of each joint's squared change. Chosen by hand: the joints near the base move the whole arm and cost more than
/// the wrist's. The same for every arm of up to seven joints; untested on arms that are built very differently.
pub(crate) const WEIGHT: Posture = [1.0, 1.0, 0.8, 0.8, 0.6, 0.6, 0.4];

/// Weighted squared distance between two postures, rad².
pub(crate) fn cost(posture: &Posture, from: &Posture) -> f64 {
    (0..7).map(|joint| WEIGHT[joint] * (posture[joint] - from[joint]).powi(2)).sum()
}
