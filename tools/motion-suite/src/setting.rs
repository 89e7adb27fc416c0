use coact_joint_task::Task;
use coact_motion::{CollisionModel, Mechanism};
use coact_robot::{HAND_JOINTS, Hand, Robot, RobotError};

/// Who moves, and at which task.
#[derive(Debug, Clone)]
pub struct Setting {
    /// The arm.
    pub mechanism: Mechanism,
    /// Its hand, when a robot file describes it.
    pub hand: Option<Hand>,
    /// The task at which it picks and inserts.
    pub task: Option<Task>,
    /// The open hand.
    pub open: CollisionModel,
}

/// Clear width of the open hand, m: wider than the widest part of the toy vehicle (75 mm).
const OPEN: f64 = 0.10;

impl Setting {
    /// A robot that a robot file describes, at a task.
    ///
    /// # Errors
    /// What is wrong with the robot's collision geometry.
    pub fn of(robot: &Robot, task: Task) -> Result<Self, RobotError> {
        let mechanism = Mechanism::of(robot)?;
        let hand = robot.hand.clone();
        let open = mechanism.with_fingers(&hand, &hand.posture(hand.base_for_width(OPEN)))?;
        Ok(Self { mechanism, hand: Some(hand), task: Some(task), open })
    }

    /// An arm that only a URDF describes.
    ///
    /// # Errors
    /// What is wrong with its collision geometry.
    pub fn foreign(mechanism: Mechanism) -> Result<Self, RobotError> {
        let open = mechanism.collision_model(&|_| 0.0)?;
        Ok(Self { mechanism, hand: None, task: None, open })
    }

    /// The arm with these angles of its hand's joints, rad. None for an arm that only a URDF describes.
    pub(crate) fn with_fingers(&self, angles: &[f64; HAND_JOINTS]) -> Option<CollisionModel> {
        self.mechanism.with_fingers(self.hand.as_ref()?, angles).ok()
    }
}
