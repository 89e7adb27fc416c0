use coact_robot::Posture;

/// A posture at a goal of the hand, and the one before the approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Index of the goal that it reaches.
    pub goal: usize,
    /// Turn of the hand about its approach, rad.
    pub roll: f64,
    /// Before the approach; the same as `at` when there is none.
    pub before: Posture,
    /// At the goal.
    pub at: Posture,
    /// Cost of the change of posture to `at`, s.
    pub cost: f64,
}
