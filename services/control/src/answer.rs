use crate::course::Course;

/// What the planner says.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Answer {
    /// The request's.
    pub id: u64,
    /// The movement, or none.
    pub course: Option<Course>,
    /// How the hand takes the part at its end, when it goes to take one: one of the [`Holds`](crate::holds::Holds).
    pub hold: Option<usize>,
    /// Whether the movement only gets the hand out of where it is: the question must be asked again.
    pub withdraws: bool,
}
