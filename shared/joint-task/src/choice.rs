/// Alternatives in the plan: of several subgoals, so many are enough.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Its name.
    pub name: String,
    /// Indices of the subgoals that it offers.
    pub of: Vec<usize>,
    /// How many of them are enough.
    pub count: usize,
    /// Indices of the subgoals that nobody needs any more once so many are achieved: those that it offers, and those that only prepare them.
    pub spares: Vec<usize>,
}

impl Choice {
    /// Whether enough of it is achieved; bit i of `achieved` is set when subgoal i is.
    pub fn is_made(&self, achieved: u64) -> bool {
        self.of.iter().filter(|&&goal| achieved & (1 << goal) != 0).count() >= self.count
    }
}
