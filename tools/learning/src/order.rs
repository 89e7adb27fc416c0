/// A connection of at least this strength stands; a single demonstration makes more than 0.8 of a source that is
/// memorised in time, and less than 0.2 of one that is not.
const STANDS: f64 = 0.5;

/// Learned connections between subgoals, and the plan that is read out of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Order {
    subgoals: usize,
    strengths: Vec<f64>,
}

impl Order {
    /// Of the strengths from each source (row) to each target.
    pub(crate) fn new(subgoals: usize, strengths: Vec<f64>) -> Self {
        Self { subgoals, strengths }
    }

    /// Strength of the connection, 0 to 1.
    pub fn strength(&self, from: usize, to: usize) -> f64 {
        self.strengths[from * self.subgoals + to]
    }

    /// Whether `from` was always memorised when `to` came about.
    pub fn stands(&self, from: usize, to: usize) -> bool {
        self.strength(from, to) >= STANDS
    }

    /// Direct predecessors of each subgoal, ascending: the transitive reduction of what stands.
    ///
    /// Two connections compete for a target when one of the sources needs the other itself: the memory of the later
    /// source implies that of the earlier one, which then explains nothing of its own and gives way.
    pub fn plan(&self) -> Vec<Vec<usize>> {
        let between = |from: usize, to: usize| {
            (0..self.subgoals).any(|middle| self.stands(from, middle) && self.stands(middle, to))
        };
        let direct = |to: usize| {
            (0..self.subgoals).filter(move |&from| self.stands(from, to) && !between(from, to)).collect()
        };
        (0..self.subgoals).map(direct).collect()
    }
}
