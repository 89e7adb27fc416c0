/// Clearance that a movement keeps at least, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MinClearance {
    /// On the reach.
    pub path: f64,
    /// Where the hand leaves, approaches and is at its goal.
    pub goal: f64,
}

/// Fraction of a reach, at either end, in which the clearance changes from the one to the other. Chosen by hand.
const NARROWING: f64 = 0.2;

impl MinClearance {
    /// At a fraction of the reach: towards both ends it narrows to that of leaving and approaching, m.
    pub(crate) fn at(&self, fraction: f64) -> f64 {
        let from_end = fraction.min(1.0 - fraction).max(0.0);
        self.goal + (self.path - self.goal) * (from_end / NARROWING).min(1.0)
    }
}

impl Default for MinClearance {
    /// 10 mm on the reach, 3 mm at the goal. Chosen by hand: a trade-off between errors of sensing and of
    /// following the movement, and the room between the parts on a table.
    fn default() -> Self {
        Self { path: 0.01, goal: 0.003 }
    }
}
