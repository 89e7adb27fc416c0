use coact_joint_task::NetworkPlan;
use coact_messages::LayerKind;

/// What the populations of the intention layer and the error monitoring layer stand for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Meanings {
    /// Goal of the person, by population of the intention layer.
    pub goals: Vec<Option<Goal>>,
    /// Subgoal that would be a mistake, by population of the error monitoring layer.
    pub errors: Vec<Option<usize>>,
}

/// A goal of the person: indices into the task's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Goal {
    /// The action chain.
    pub chain: usize,
    /// The subgoal that it serves.
    pub subgoal: usize,
}

impl From<&NetworkPlan> for Meanings {
    fn from(plan: &NetworkPlan) -> Self {
        let goals = plan.populations_of(LayerKind::Intention).iter().map(|population| {
            population.chain_index.zip(population.subgoal).map(|(chain, subgoal)| Goal { chain, subgoal })
        });
        let errors = plan.populations_of(LayerKind::ErrorMonitoring).iter();
        Self { goals: goals.collect(), errors: errors.map(|population| population.subgoal).collect() }
    }
}
