use crate::pooled_input::PooledInput;
use coact_joint_task::{NetworkPlan, Pool};

/// What a population gets from one synapse, or from a group of them that counts as one.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// The rule that made it: index into [`NetworkPlan::reasons`](coact_joint_task::NetworkPlan::reasons).
    pub rule: usize,
    /// How its sources add up.
    pub pool: Pool,
    /// Its sources, with their signals, 0 to 1: places in the plan's row of populations and channels.
    pub sources: Vec<(usize, f64)>,
    /// Strength of each of its synapses, in units of the input that ignites the population.
    pub weight: f64,
    /// What it gives right now, in the same units.
    pub amount: f64,
}

impl Share {
    pub(crate) fn new(rule: usize, pool: Pool, weight: f64, sources: Vec<(usize, f64)>) -> Self {
        let mut input = PooledInput::NOTHING;
        sources.iter().filter(|(_, signal)| *signal > 0.0).for_each(|(_, signal)| input.add(*signal));
        let amount = weight * input.counts(pool, sources.len() as u32);
        Self { rule, pool, sources, weight, amount }
    }

    /// The source that decides what it gives: the strongest, or where all are needed, the weakest.
    pub fn decisive(&self) -> (usize, f64) {
        let by_signal = |one: &&(usize, f64), other: &&(usize, f64)| one.1.total_cmp(&other.1);
        let found = match self.pool {
            Pool::Every => self.sources.iter().min_by(by_signal),
            Pool::Sum | Pool::Any | Pool::Absent => self.sources.iter().max_by(by_signal),
        };
        found.copied().unwrap_or_default()
    }

    /// The source that is missing, when all others stand that are needed with it.
    pub fn missing(&self) -> Option<usize> {
        let mut missing = self.sources.iter().filter(|(_, signal)| *signal <= 0.0);
        let (Some((only, _)), None) = (missing.next(), missing.next()) else { return None };
        (self.pool == Pool::Every && self.weight > 0.0 && self.sources.len() > 1).then_some(*only)
    }

    /// In words, which source decides, and how many stand beside it.
    pub fn from(&self, plan: &NetworkPlan) -> String {
        let decisive = plan.name(self.decisive().0);
        let others = self.sources.iter().filter(|(_, signal)| *signal > 0.0).count().saturating_sub(1);
        match (self.pool, others) {
            (Pool::Absent, _) => format!("{decisive}, which does not stand"),
            (_, 0) | (Pool::Sum, _) => decisive,
            (Pool::Any, _) => format!("{decisive}, the strongest of {}", others + 1),
            (Pool::Every, _) => format!("{decisive}, the weakest of {} that are all needed", others + 1),
        }
    }
}
