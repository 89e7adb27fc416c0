use crate::{HandPath, Mechanism, Plan, Refusal};

/// The best plan that a search has found so far: the one that costs least. Without a plan, the first reason why there is none.
#[derive(Debug, Default)]
pub(crate) struct Incumbent {
    best: Option<(Cost, Plan)>,
    refusal: Option<Refusal>,
}

/// What a plan costs, s, and the least that a movement to its target could cost.
#[derive(Debug, Clone, Copy)]
struct Cost {
    seconds: f64,
    least: f64,
}

/// What each movement unit after the first costs, s, and how many are counted: a hand that slows down and speeds up again looks as if it
/// hesitated, but is not worth a detour of seconds. Chosen by hand.
const UNIT_S: f64 = 0.15;
const UNITS: u32 = 3;
/// Places of the hand at which movement units are counted. A trade-off with the time of planning.
const PLACES: usize = 80;
/// A search goes on for this fraction of what its best plan costs more than the least. Chosen by hand: somebody waits for it.
const WORTH: f64 = 0.015;

impl Incumbent {
    /// Takes this plan if it costs less than the best so far. `least`: the shortest time in which the joints could be there, s.
    pub fn offer(&mut self, mechanism: &Mechanism, plan: Plan, least: f64) {
        let units = HandPath::of(mechanism, &plan, PLACES).units().min(UNITS);
        let seconds = plan.duration() + UNIT_S * f64::from(units - 1);
        if self.best.as_ref().is_none_or(|(best, _)| seconds < best.seconds) {
            self.best = Some((Cost { seconds, least }, plan));
        }
    }

    /// Keeps the first reason why there is no plan.
    pub fn refuse(&mut self, refusal: Refusal) {
        _ = self.refusal.get_or_insert(refusal);
    }

    /// Whether there is no plan yet.
    pub fn is_none(&self) -> bool {
        self.best.is_none()
    }

    /// Whether there is a plan, and to look for a better one after `spent` s would take longer than it may bring.
    pub fn is_good_after(&self, spent: f64) -> bool {
        self.best.as_ref().is_some_and(|(cost, _)| spent > WORTH * (cost.seconds - cost.least))
    }

    /// The plan, or why there is none.
    pub fn result(self) -> Result<Plan, Refusal> {
        let refusal = self.refusal.unwrap_or(Refusal::OutOfReach { point: [0.0; 3] });
        self.best.map(|(_, plan)| plan).ok_or(refusal)
    }
}
