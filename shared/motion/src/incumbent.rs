use crate::roughness::Roughness;
use crate::{Plan, Refusal, Target};

/// The best plan that a search has found so far: the smoothest one. Without a plan, the first reason why there is none.
#[derive(Debug, Default)]
pub(crate) struct Incumbent {
    best: Option<(Roughness, Plan)>,
    refusal: Option<Refusal>,
}

impl Incumbent {
    /// Takes this plan if it is smoother than the best so far.
    pub fn offer(&mut self, (roughness, plan): (Roughness, Plan), target: Option<Target>, bounces: bool) {
        if self.best.as_ref().is_none_or(|(best, _)| roughness < *best) {
            self.best = Some((roughness, Plan { target, bounces, ..plan }));
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

    /// Whether the hand moves in one movement unit.
    pub fn is_smooth(&self) -> bool {
        self.best.as_ref().is_some_and(|(roughness, _)| roughness.units == 1)
    }

    /// The plan, or why there is none.
    pub fn result(self) -> Result<Plan, Refusal> {
        let refusal = self.refusal.unwrap_or(Refusal::OutOfReach { point: [0.0; 3] });
        self.best.map(|(_, plan)| plan).ok_or(refusal)
    }
}
