/// From this strength on a connection counts as a condition: when that is as likely as not.
const CONDITION: f64 = 0.5;

/// Learned connections between subgoals, and the plan that is read out of them.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedOrder {
    subgoals: usize,
    strengths: Vec<f64>,
}

impl LearnedOrder {
    /// Of the strengths from each source (row) to each target.
    pub(crate) fn new(subgoals: usize, strengths: Vec<f64>) -> Self {
        Self { subgoals, strengths }
    }

    /// Strength of the connection, 0 to 1: how likely the one is a condition of the other.
    pub fn strength(&self, from: usize, to: usize) -> f64 {
        self.strengths[from * self.subgoals + to]
    }

    /// Whether `from` was memorised whenever `to` came about, but for a mistake.
    pub fn is_condition(&self, from: usize, to: usize) -> bool {
        self.strength(from, to) >= CONDITION
    }

    /// Direct predecessors of each subgoal, ascending: the transitive reduction of all conditions.
    ///
    /// Two connections compete for a target when one of the sources needs the other itself: the memory of the later
    /// source implies that of the earlier one, which then explains nothing of its own and is left out.
    pub fn plan(&self) -> Vec<Vec<usize>> {
        let between = |from: usize, to: usize| {
            (0..self.subgoals).any(|middle| self.is_condition(from, middle) && self.is_condition(middle, to))
        };
        let direct = |to: usize| {
            (0..self.subgoals)
                .filter(move |&from| self.is_condition(from, to) && !between(from, to))
                .collect()
        };
        (0..self.subgoals).map(direct).collect()
    }
}
