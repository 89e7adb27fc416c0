use serde::{Deserialize, Serialize};

/// One of the partner's actions, and how the robot answered it.
///
/// Times are ms from the start of the run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ActionEvent {
    /// Number of the action in the run, from 1.
    pub action: u32,
    /// Name of the chain that the partner carried out.
    pub chain: String,
    /// Name of the kind of part.
    pub kind: String,
    /// Name of the subgoal that the partner meant.
    pub subgoal: String,
    /// Reach onset.
    pub onset_ms: u64,
    /// Grasp completion, as the simulation says.
    pub grasp_ms: u64,
    /// When the peak that counts crossed threshold: the right one, or a wrong one that stood at grasp completion.
    pub decided_ms: Option<u64>,
    /// Decision lead: `grasp_ms` minus `decided_ms`; negative when the decision came too late.
    pub lead_ms: Option<i64>,
    /// Name of what was decided; none when nothing was decided about this action.
    pub decided: Option<String>,
    /// Name of what should have been decided; none where the task expects nothing.
    pub expected: Option<String>,
    /// The decision is the expected one (in time or not).
    pub correct: bool,
}

impl ActionEvent {
    /// The right decision stood before the grasp was complete.
    pub fn anticipated(&self) -> bool {
        self.correct && self.decided_before_grasp()
    }

    /// Some decision about this action stood before the grasp was complete.
    pub fn decided_before_grasp(&self) -> bool {
        self.lead_ms.is_some_and(|lead| lead > 0)
    }

    /// At grasp completion a wrong decision about this action stood.
    pub fn wrong(&self) -> bool {
        self.expected.is_some() && self.decided.is_some() && !self.correct
    }
}
