use crate::Waiting;
use serde::{Deserialize, Serialize};

/// What one of the two did for a time. Those of an agent follow each other without a gap.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TimelineSpan {
    /// Whose it is.
    pub who: Waiting,
    /// What was done.
    pub occupation: Occupation,
    /// The robot's action, or the person's chain and subgoal; empty where there is none.
    pub what: String,
    /// From when on, ms from the start.
    pub from_ms: u64,
    /// Until when.
    pub until_ms: u64,
}

/// How an agent spends its time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Occupation {
    /// The robot's arm, or the person's hand, is on its way to something.
    Reaches,
    /// It carries a part.
    Carries,
    /// The robot's hand goes straight to what it is about to touch.
    Approaches,
    /// The robot's fingers close or open, or the person mounts a part.
    Handles,
    /// The robot steadies the base that the person mounts something on.
    Steadies,
    /// The robot's hand goes to where a preshaped action begins.
    Prepares,
    /// It goes away from where it was, with nothing to do.
    Withdraws,
    /// The robot is slower than planned for the person's sake, or stopped.
    HeldBack,
    /// The robot stands until its next movement is found.
    Plans,
    /// It waits for the other: the robot for whatever the person does next in a handover or at the base.
    Waits,
    /// The person waits for the base to be steadied.
    WaitsForSteadying,
    /// The person holds a part out.
    WaitsForReceiving,
    /// The person holds the open hand out for a part.
    WaitsForPart,
    /// The person has the fingers on a part that the robot does not let go yet.
    WaitsForRelease,
    /// The person can do nothing before the robot has achieved a step of its own.
    WaitsForSubgoal,
    /// Nothing.
    Rests,
}

impl Occupation {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reaches => "reaches",
            Self::Carries => "carries",
            Self::Approaches => "approaches",
            Self::Handles => "handles",
            Self::Steadies => "steadies",
            Self::Prepares => "prepares",
            Self::Withdraws => "withdraws",
            Self::HeldBack => "held back",
            Self::Plans => "plans",
            Self::Waits => "waits",
            Self::WaitsForSteadying => "waits for steadying",
            Self::WaitsForReceiving => "waits for receiving",
            Self::WaitsForPart => "waits for a part",
            Self::WaitsForRelease => "waits for release",
            Self::WaitsForSubgoal => "waits for the robot's step",
            Self::Rests => "rests",
        }
    }

    /// Whether it is to wait for the other agent.
    pub fn is_waiting(self) -> bool {
        matches!(
            self,
            Self::Waits
                | Self::WaitsForSteadying
                | Self::WaitsForReceiving
                | Self::WaitsForPart
                | Self::WaitsForRelease
                | Self::WaitsForSubgoal
        )
    }
}

impl TimelineSpan {
    /// How long it was, s.
    pub fn seconds(&self) -> f64 {
        self.until_ms.saturating_sub(self.from_ms) as f64 / 1e3
    }
}
