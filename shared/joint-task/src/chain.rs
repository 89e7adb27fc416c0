use crate::{Act, Agent};

/// A chain of action primitives of the person, for one kind of part (e.g. reach - grasp from above - insert).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chain {
    /// Name of the rule, e.g. "insert".
    pub name: String,
    /// The act that shows it.
    pub act: Act,
    /// Index of the kind of part.
    pub kind: usize,
    /// In whose workspace the part lies.
    pub from: Agent,
    /// Whose subgoal it serves.
    pub side: Agent,
    /// Name of the robot's action that complements it, if one does: with the chain's subgoal it names an action.
    pub answer: Option<String>,
    /// Whether the person may point at the part instead.
    pub pointing: bool,
    /// Phrases by which the person says that this is meant, in lower case; none: it is not spoken of.
    pub says: Vec<String>,
}
