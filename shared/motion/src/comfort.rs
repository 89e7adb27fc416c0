//! What a change of posture costs a collision_model: people end where the joints have the least way to go.

use coact_robot::Posture;

/// Cost of each joint's way: moving the whole arm costs more than turning the wrist.
pub(crate) const WEIGHT: Posture = [1.0, 1.0, 0.8, 0.8, 0.6, 0.6, 0.4];

/// Weighted squared way between two postures, rad².
pub(crate) fn cost(posture: &Posture, from: &Posture) -> f64 {
    (0..7).map(|joint| WEIGHT[joint] * (posture[joint] - from[joint]).powi(2)).sum()
}
