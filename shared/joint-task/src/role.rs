use crate::ActionType;
use serde::Deserialize;
use std::fmt;

/// How an act, a chain, a goal, an error or an action works: what the rules of the network file select by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Act: the hand lies at rest.
    Rest,
    /// Act: the hand has been at rest for long.
    Idle,
    /// Act: the hand is on its way.
    Reach,
    /// Act: the hand has gone out of sight on its way.
    Hidden,
    /// Act: the person says what a chain is for.
    Word,
    /// Act: the empty hand shows a gesture. Chain and goal: a gesture shows them.
    Gesture,
    /// Act: the hand prepares for, grasps or holds a part.
    Grasp,
    /// Chain and goal: a grip shows them.
    Grip,
    /// Chain and goal: nothing of the hand shows them.
    Movement,
    /// Memory of the parts of one kind in a workspace.
    Object,
    /// A step of the plan.
    Subgoal,
    /// Of several steps of the plan, enough are achieved.
    Choice,
    /// Error: the turn of the goal has not come.
    Goal,
    /// Error: the goal has been achieved already.
    Done,
    /// Error: a part is asked for that lies at hand.
    Means,
    /// Error: the robot has lost a part.
    Loss,
    /// Action of [`ActionType::Insert`].
    Insert,
    /// Action of [`ActionType::Request`].
    Request,
    /// Action of [`ActionType::Receive`].
    Receive,
    /// Action of [`ActionType::Give`].
    Give,
    /// Action of [`ActionType::Steady`].
    Steady,
    /// Act: the hand points at a part. Action of [`ActionType::Point`].
    Point,
    /// Action of [`ActionType::Speak`].
    Speak,
    /// Action of [`ActionType::Report`].
    Report,
    /// The channel that is a constant 1.
    Always,
}

impl fmt::Display for Role {
    /// As network files write it.
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.pad(&format!("{self:?}").to_lowercase())
    }
}

impl From<ActionType> for Role {
    fn from(action_type: ActionType) -> Self {
        match action_type {
            ActionType::Insert => Self::Insert,
            ActionType::Request => Self::Request,
            ActionType::Receive => Self::Receive,
            ActionType::Give => Self::Give,
            ActionType::Steady => Self::Steady,
            ActionType::Point => Self::Point,
            ActionType::Speak => Self::Speak,
            ActionType::Report => Self::Report,
        }
    }
}
