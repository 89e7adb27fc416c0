use coact_messages::ARM_JOINTS;
use coact_robot::HAND_JOINTS;

/// How far a part between the fingers lets them close.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FingerStop {
    /// Hand joint angles at which the fingers touch the part, rad; none when there is no part.
    pub hand: Option<[f64; HAND_JOINTS]>,
}

impl FingerStop {
    /// Largest angle of a joint (message order), rad.
    pub fn limit(&self, joint: usize) -> f64 {
        match (self.hand, joint) {
            (Some(hand), 8..=13) => hand[joint - ARM_JOINTS],
            _ => f64::INFINITY,
        }
    }
}
