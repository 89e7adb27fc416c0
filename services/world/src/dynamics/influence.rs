use super::finger_stop::FingerStop;
use coact_joint_task::Task;
use coact_messages::JOINTS;
use coact_robot::MotionState;
use glam::DVec3;

/// What robot and parts are moved by in one step.
#[derive(Clone, Copy)]
pub(crate) struct Influence<'a> {
    /// What the joints follow; none before the drive has started.
    pub setpoints: Option<&'a [MotionState; JOINTS]>,
    pub stop: FingerStop,
    pub task: &'a Task,
    /// The person's hand, m.
    pub person: DVec3,
    /// The part in the robot's hand.
    pub held: Option<usize>,
    /// The part that has slipped out of the robot's hand, whose fingers are still closed.
    pub slipped: Option<usize>,
    /// Force of the person on the part in the robot's hand, N.
    pub pull: DVec3,
}
