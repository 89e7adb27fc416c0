use crate::{ActionEvent, FaultEvent};

/// One line of `events.jsonl`: something that the report tells. Times are ms from the start of the run.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// A subgoal's part came into its place (truth).
    Subgoal {
        /// When.
        at_ms: u64,
        /// Assemblies completed before.
        assembly: u64,
        /// Index of the subgoal.
        subgoal: usize,
        /// Its name.
        name: String,
    },
    /// The last part came into its place, or the scene was laid out again.
    Assembly {
        /// When.
        at_ms: u64,
        /// Assemblies completed, this one included.
        completed: u64,
    },
    /// The fields lost the memory of a subgoal that is still achieved.
    Forgotten {
        /// When.
        at_ms: u64,
        /// Name of the subgoal.
        name: String,
    },
    /// The robot decided on another action.
    Decision {
        /// When its peak crossed threshold.
        at_ms: u64,
        /// Name of the action.
        action: String,
    },
    /// The robot said something.
    Utterance {
        /// When.
        at_ms: u64,
        /// What.
        text: String,
    },
    /// One of the partner's actions was answered, or not.
    Action(ActionEvent),
    /// A fault, and how the set came over it.
    Fault(FaultEvent),
}

impl Event {
    /// The partner's action that the event is about, if it is about one.
    pub fn as_action(&self) -> Option<&ActionEvent> {
        match self {
            Self::Action(action) => Some(action),
            _ => None,
        }
    }
}
