/// What perception can observe of the person's hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Act {
    /// The hand lies at rest now.
    Rest,
    /// The hand has been at rest for long: evidence grows with the seconds.
    Idle,
    /// The hand is on its way to something.
    Reach,
    /// The hand has gone out of sight on its way: behind something, where its grip cannot be seen.
    Hidden,
    /// The person says what a chain is for ("give me the wheel"): index into `Task::chains`.
    Word(usize),
    /// The hand points at a part of the kind that a chain is about: index into `Task::chains`.
    Point(usize),
    /// The empty hand shows a gesture: index into `Task::gestures`.
    Gesture(usize),
    /// The hand preshapes for, grasps or holds a part of `kind` with `grip`.
    Grasp {
        /// Index into `Task::grips`.
        grip: usize,
        /// Index into `Task::kinds`.
        kind: usize,
    },
}
