use coact_joint_task::NetworkPlan;
use coact_messages::{LayerKind, MAX_KINDS};
use std::ops::Range;

/// What the plan makes of where a hand may go, before it goes anywhere: people reach for what some step needs now, and seldom for anything
/// else (chapter, section 4: shared task knowledge biases what is seen).
#[derive(Debug, Clone)]
pub(crate) struct DueKinds {
    /// Populations of the subgoals that are available, in the row of all, and their kinds.
    available: Range<usize>,
    kinds: Vec<usize>,
    /// Of a kind that no available step needs.
    undue: f64,
}

/// How likely a reach for a part of each kind is beforehand, against one for a kind that is due.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Beforehand(pub [f64; MAX_KINDS]);

impl DueKinds {
    pub fn of(plan: &NetworkPlan) -> Self {
        let populations = plan.populations_of(LayerKind::SubgoalsAvailable).iter();
        Self {
            available: plan.layer(LayerKind::SubgoalsAvailable).populations.clone(),
            kinds: populations.map(|population| population.kind.unwrap_or(MAX_KINDS)).collect(),
            undue: plan.undue,
        }
    }

    /// By the signals of all populations: as far as a step for it is available, a kind is due.
    pub fn beforehand(&self, signal: &[f64]) -> Beforehand {
        let mut of_kind = [self.undue; MAX_KINDS];
        for (&kind, &available) in self.kinds.iter().zip(&signal[self.available.clone()]) {
            if let Some(likely) = of_kind.get_mut(kind) {
                *likely = likely.max(self.undue + (1.0 - self.undue) * available);
            }
        }
        Beforehand(of_kind)
    }
}

impl Beforehand {
    /// Where nothing is taken, the plan says nothing.
    pub fn of(&self, kind: Option<usize>) -> f64 {
        kind.map_or(1.0, |kind| self.0[kind])
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn a_kind_is_due_as_far_as_a_step_that_needs_it_is_available() {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (task, plan) = NetworkPlan::load(&task).unwrap();
        let due = DueKinds::of(&plan);
        let mut signal = vec![0.0; plan.populations.len()];
        let undue = plan.undue;
        assert!((0..task.kinds.len()).all(|kind| due.beforehand(&signal).of(Some(kind)) == undue));
        let first = plan.layer(LayerKind::SubgoalsAvailable).populations.start;
        let kind = task.subgoals[0].kind;
        for available in [0.5, 1.0] {
            signal[first] = available;
            let beforehand = due.beforehand(&signal);
            for own in 0..task.kinds.len() {
                let expected = if own == kind { undue + (1.0 - undue) * available } else { undue };
                assert_eq!(beforehand.of(Some(own)), expected, "{own}");
            }
            assert_eq!(beforehand.of(None), 1.0);
        }
    }
}
