use crate::{ActionEvent, FaultEvent, Record, TimelineSpan, WaitEvent};
use serde::{Deserialize, Serialize};

/// One line of the event log, `events.jsonl`: what happened in a run. Times are ms from its start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// A subgoal's part came into its place (truth).
    Subgoal {
        /// When.
        at_ms: u64,
        /// Number of the assembly in the run, from 0.
        assembly: u64,
        /// Index of the subgoal in the task.
        subgoal: usize,
        /// Its name.
        name: String,
    },
    /// The robot has perceived that a subgoal is achieved: its peak has risen in the layer of achieved subgoals, for the first time in this
    /// assembly.
    Perceived {
        /// When it crossed threshold.
        at_ms: u64,
        /// Number of the assembly in the run, from 0.
        assembly: u64,
        /// Index of the subgoal in the task.
        subgoal: usize,
        /// Its name.
        name: String,
    },
    /// An assembly was completed: its last part came into its place, or the scene was laid out again.
    Assembly {
        /// When.
        at_ms: u64,
        /// Assemblies completed, this one included.
        completed: u64,
    },
    /// The peak that stands for an achieved subgoal is gone, though the subgoal is still achieved.
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
    /// One of the two waited for the other (truth).
    Wait(WaitEvent),
    /// What one of the two did for a time (truth).
    Span(TimelineSpan),
    /// A fault, and how the set came over it.
    Fault(FaultEvent),
    /// The monitor did not see what happened: it stood still for so long, or was restarted, that messages were lost.
    Blind {
        /// From when on.
        from_ms: u64,
        /// Until when.
        until_ms: u64,
    },
}

impl Record for Event {
    const FILE: &'static str = "events.jsonl";
}

impl Event {
    /// The partner's action that the event is about, if it is about one.
    pub fn as_action(&self) -> Option<&ActionEvent> {
        match self {
            Self::Action(action) => Some(action),
            _ => None,
        }
    }

    /// What one of the two did, if the event is about that.
    pub fn as_span(&self) -> Option<&TimelineSpan> {
        match self {
            Self::Span(span) => Some(span),
            _ => None,
        }
    }

    /// The wait that the event is about, if it is about one.
    pub fn as_wait(&self) -> Option<&WaitEvent> {
        match self {
            Self::Wait(wait) => Some(wait),
            _ => None,
        }
    }
}
