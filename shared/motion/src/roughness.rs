use crate::{HandPath, Mechanism, Plan};

/// How far a movement of the hand is from one smooth and short bell: first its units count, then the rest.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct Roughness {
    /// Movement units.
    pub units: u32,
    /// Normalised jerk times duration, s.
    pub jerk: f64,
}

impl Roughness {
    /// Of a plan, looked at in so many places.
    pub fn of(mechanism: &Mechanism, plan: &Plan, places: usize) -> Self {
        let path = HandPath::of(mechanism, plan, places);
        Self { units: path.units(), jerk: path.normalised_jerk() * plan.duration() }
    }
}
