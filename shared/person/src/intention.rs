use crate::{Activity, Variation};

/// What the person means to do next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intention {
    /// What it is for.
    pub activity: Activity,
    /// The chain of acts: index into `Task::chains`.
    pub chain: usize,
    /// The subgoal that it serves: index into `Task::subgoals`.
    pub subgoal: Option<usize>,
    /// The part that the hand goes to; none for a gesture.
    pub part: Option<usize>,
    /// How it differs from the plain activity.
    pub variation: Variation,
}

/// The outcome of thinking about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Undertaking {
    /// Set about this.
    Begin(Intention),
    /// Rest for so many cycles, then think again.
    Rest(u64),
    /// The same because nothing can be done before the robot has done something.
    Await(u64),
}
