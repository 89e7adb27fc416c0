use coact_joint_task::NetworkPlan;
use coact_messages::LayerKind;

/// Which population of the intention layer stands for which of the partner's goals.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Intentions {
    names: Vec<String>,
    of: Vec<((usize, usize), usize)>,
}

impl Intentions {
    /// From the names of the layer's populations, in their order, and for each of them the pairs of chain and
    /// subgoal (indices into the task's lists) that mean it.
    pub fn new(populations: impl IntoIterator<Item = (String, Vec<(usize, usize)>)>) -> Self {
        let mut intentions = Self::default();
        for (index, (name, goals)) in populations.into_iter().enumerate() {
            intentions.names.push(name);
            intentions.of.extend(goals.into_iter().map(|goal| (goal, index)));
        }
        intentions
    }

    /// The population for a chain that serves a subgoal.
    pub fn population(&self, chain: usize, subgoal: usize) -> Option<usize> {
        self.of.iter().find(|(goal, _)| *goal == (chain, subgoal)).map(|&(_, population)| population)
    }

    /// Name of a population.
    pub fn name(&self, population: usize) -> Option<&str> {
        self.names.get(population).map(String::as_str)
    }
}

impl From<&NetworkPlan> for Intentions {
    fn from(plan: &NetworkPlan) -> Self {
        Self::new(plan.populations_of(LayerKind::Intention).iter().map(|population| {
            let goal = population.chain_index.zip(population.subgoal);
            (population.label.clone(), goal.into_iter().collect())
        }))
    }
}
