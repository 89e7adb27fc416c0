use crate::{Act, Action, Chain, Gesture, Grip, Kind, Part, Scene, Subgoal};

/// A joint task as its file describes it: parts, plan, what the person's hand can show, what the robot can do.
///
/// All references between the lists are indices, checked when the file is loaded. The index of an act, kind,
/// subgoal, chain or action in these lists is its index in every message.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// The task's name.
    pub name: String,
    /// Kinds of part.
    pub kinds: Vec<Kind>,
    /// Single parts, and where they lie at the start.
    pub parts: Vec<Part>,
    /// The plan: subgoals in partial order.
    pub subgoals: Vec<Subgoal>,
    /// Grips that tell what is meant.
    pub grips: Vec<Grip>,
    /// Gestures of the empty hand.
    pub gestures: Vec<Gesture>,
    /// What perception can observe of the person: one population of the action observation layer each.
    pub acts: Vec<Act>,
    /// Action chains of the person, one for each rule and kind of part: one population of ASL each.
    pub chains: Vec<Chain>,
    /// The robot's actions: one population of AEL each.
    pub actions: Vec<Action>,
    /// The table, the base and the places on it.
    pub scene: Scene,
    /// Hash of the task's and the network's file contents: two frames with the same fingerprint fit each other.
    pub fingerprint: u64,
}

/// Why a task file was refused.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct TaskError(pub String);

impl Task {
    /// Reads a task file and the network file that it names.
    ///
    /// # Errors
    /// A [`TaskError`] that names file, line, key and what was expected.
    pub fn load(path: &std::path::Path) -> Result<Self, TaskError> {
        Err(TaskError(format!("{}: not yet readable", path.display())))
    }
}
