use coact_joint_task::{NetworkPlan, Population, Role};
use coact_messages::LayerKind;

/// What the populations of the layers stand for that the robot speaks of, in their order in the field.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Meanings {
    /// Chain that the person's words name (index into `Task::chains`), of the action observation layer.
    pub words: Vec<Option<usize>>,
    /// Goal of the person, of the intention layer.
    pub goals: Vec<Option<Goal>>,
    /// What is wrong, of the error monitoring layer.
    pub errors: Vec<Option<Mistake>>,
}

/// A goal of the person: indices into the task's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Goal {
    /// The action chain.
    pub chain: usize,
    /// The subgoal that it serves.
    pub subgoal: usize,
}

/// What can be wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mistake {
    /// The person means to bring about this subgoal, whose turn it is not: index into `Task::subgoals`.
    Goal(usize),
    /// The person asks for a part of this kind, which lies at hand: index into `Task::kinds`.
    Means(usize),
    /// The robot has lost a part of this kind.
    Loss(usize),
}

impl From<&NetworkPlan> for Meanings {
    fn from(plan: &NetworkPlan) -> Self {
        let of = |layer| plan.populations_of(layer).iter();
        let word = |population: &Population| population.chain_index.filter(|_| population.role == Role::Word);
        let goal = |population: &Population| {
            population.chain_index.zip(population.subgoal).map(|(chain, subgoal)| Goal { chain, subgoal })
        };
        let error = |population: &Population| match population.role {
            Role::Means => population.kind.map(Mistake::Means),
            Role::Loss => population.kind.map(Mistake::Loss),
            _ => population.subgoal.map(Mistake::Goal),
        };
        Self {
            words: of(LayerKind::ActionObservation).map(word).collect(),
            goals: of(LayerKind::Intention).map(goal).collect(),
            errors: of(LayerKind::ErrorMonitoring).map(error).collect(),
        }
    }
}
