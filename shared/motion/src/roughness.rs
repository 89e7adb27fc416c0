use crate::{HandPath, Mechanism, Plan};

/// How far a movement of the hand is from one smooth and short bell: first its units count, then the rest.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct Roughness {
    /// PointToPoint units, and one for every [`PATIENCE`] that it takes.
    pub units: u32,
    /// Normalised jerk times duration, s.
    pub jerk: f64,
}

/// For how long a partner waits for a movement before it seems to hesitate, s.
const PATIENCE: f64 = 4.0;

impl Roughness {
    /// Of a plan, looked at in so many places.
    pub fn of(mechanism: &Mechanism, plan: &Plan, places: usize) -> Self {
        let path = HandPath::of(mechanism, plan, places);
        let waits = (plan.duration() / PATIENCE) as u32;
        Self { units: path.units() + waits, jerk: path.normalised_jerk() * plan.duration() }
    }
}
