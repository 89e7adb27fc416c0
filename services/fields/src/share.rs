use coact_joint_task::Pool;

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
        let signals = || sources.iter().map(|(_, signal)| *signal);
        let counts = match pool {
            Pool::Sum => signals().sum(),
            Pool::Any => signals().fold(0.0, f64::max),
            Pool::Every => signals().fold(f64::INFINITY, f64::min).max(0.0),
        };
        Self { rule, pool, sources, weight, amount: weight * counts }
    }

    /// The source that decides what it gives: the strongest, or where all are needed, the weakest.
    pub fn decisive(&self) -> (usize, f64) {
        let by_signal = |one: &&(usize, f64), other: &&(usize, f64)| one.1.total_cmp(&other.1);
        let found = match self.pool {
            Pool::Every => self.sources.iter().min_by(by_signal),
            Pool::Sum | Pool::Any => self.sources.iter().max_by(by_signal),
        };
        found.copied().unwrap_or_default()
    }
}
