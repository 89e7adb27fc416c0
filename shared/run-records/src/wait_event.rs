use serde::{Deserialize, Serialize};

/// A time in which one of the two, in the middle of an action, could go on only after the other had done something.
///
/// Times are ms from the start of the run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct WaitEvent {
    /// Who waited.
    pub who: Waiting,
    /// From when on.
    pub from_ms: u64,
    /// Until when.
    pub until_ms: u64,
    /// Name of the subgoal that the wait was for; empty when none was meant.
    pub subgoal: String,
}

/// Who waited for the other one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Waiting {
    /// The robot, for the person.
    Robot,
    /// The person, for the robot.
    Person,
}

impl WaitEvent {
    /// How long it was, s.
    pub fn seconds(&self) -> f64 {
        self.until_ms.saturating_sub(self.from_ms) as f64 / 1e3
    }
}
