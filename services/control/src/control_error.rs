/// Why control refuses to start.
#[derive(Debug, thiserror::Error)]
pub enum ControlError {
    /// The hand cannot get where the task needs it.
    #[error(
        "the robot's hand cannot reach {what} at {place:?} m; expected a place with a posture within the joint limits, \
         hand {towards}; move it in the task file"
    )]
    Unreachable {
        /// What is there.
        what: String,
        /// Where, m, world frame.
        place: [f64; 3],
        /// How the hand would have to stand there.
        towards: String,
    },
    /// The hand cannot grasp a kind of part.
    #[error(
        "the robot's hand has no grip for \"{name}\", {width} m wide; expected a width that its fingers open around; \
         change it in the task file, or use another hand"
    )]
    Ungraspable {
        /// The kind's name.
        name: String,
        /// How far the fingers would close, m.
        width: f64,
    },
    /// The arm's or the hand's collision geometry cannot be used.
    #[error(transparent)]
    Robot(#[from] coact_robot::RobotError),
}
