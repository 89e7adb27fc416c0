use crate::{HandPath, Mechanism, Plan};

/// How far a movement of the hand is from a single smooth, short rise and fall of speed. Plans are compared by it: first
/// by `units`, then by `jerk`.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct Roughness {
    /// Movement units, and one more for every [`PATIENCE_S`] that the movement takes.
    pub units: u32,
    /// Normalised jerk times duration, s.
    pub jerk: f64,
}

/// Duration of a movement that counts as much as one more movement unit, s: about as long as a partner waits before a
/// movement seems to hesitate. Chosen by hand; reaches of one to two seconds are not affected.
const PATIENCE_S: f64 = 4.0;

impl Roughness {
    /// Of a plan, sampled at this many places of the hand.
    pub fn of(mechanism: &Mechanism, plan: &Plan, places: usize) -> Self {
        let path = HandPath::of(mechanism, plan, places);
        let waits = (plan.duration() / PATIENCE_S) as u32;
        Self { units: path.units() + waits, jerk: path.normalised_jerk() * plan.duration() }
    }
}
