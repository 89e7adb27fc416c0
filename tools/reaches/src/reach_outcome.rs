use serde::Serialize;

/// Fractions of movement time at which the goal that stands is judged.
pub const FRACTIONS: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

/// What was inferred from one reach.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReachOutcome {
    /// The person.
    pub participant: u32,
    /// Number of the trial.
    pub trial: u32,
    /// Width of the object that was reached for, m (truth).
    pub width: f64,
    /// Movement time, ms (truth).
    pub movement_ms: i64,
    /// Perception's onset against the label, ms; `None` when it found none before contact.
    pub onset_ms: Option<i64>,
    /// Whether the goal that stood at each of [`FRACTIONS`] was the right one; `None` where none stood.
    pub right_during_reach: [Option<bool>; 5],
    /// The decision that stood at contact.
    pub decision: Option<GoalDecision>,
    /// The robot's answer to it that stood in AEL at contact: for which part it was decided.
    pub answer: Option<GoalDecision>,
}

/// A decision that was taken before contact and stayed until then.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GoalDecision {
    /// Whether it was the right one.
    pub right: bool,
    /// Contact minus decision, ms.
    pub lead_ms: i64,
    /// Width of the part that was decided for, m.
    pub width: f64,
}

impl ReachOutcome {
    /// Whether the right goal was decided before contact.
    pub fn is_right(&self) -> bool {
        self.decision.is_some_and(|decision| decision.right)
    }

    /// Whether the robot had decided on the right answer before contact.
    pub fn is_answered(&self) -> bool {
        self.answer.is_some_and(|answer| answer.right)
    }
}
