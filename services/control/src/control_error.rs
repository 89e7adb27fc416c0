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
    /// The arm's or the hand's collision geometry cannot be used.
    #[error(transparent)]
    Robot(#[from] coact_robot::RobotError),
}
