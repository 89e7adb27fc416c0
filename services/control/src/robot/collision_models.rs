use coact_joint_task::{Shape, Task};
use coact_motion::{CollisionModel, Mechanism};
use coact_robot::{HAND_JOINTS, Hand, Robot, RobotError};
use nalgebra::Isometry3;

/// Makes the collision models of arm and hand, for any shape of the fingers and any held part.
#[derive(Debug, Clone)]
pub(crate) struct CollisionModels {
    pub mechanism: Mechanism,
    hand: Hand,
    /// Shapes of the kinds of parts.
    pub shapes: Vec<Shape>,
}

impl CollisionModels {
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn new(robot: &Robot, task: &Task) -> Result<Self, RobotError> {
        Ok(Self {
            mechanism: Mechanism::of(robot)?,
            hand: robot.hand.clone(),
            shapes: task.kinds.iter().map(|kind| kind.shape).collect(),
        })
    }

    /// Arm and hand whose fingers pass through these shapes (angles, rad), around or on what is held: its kind, and its frame
    /// in the palm's.
    ///
    /// # Errors
    /// [`RobotError`] when the hand's collision geometry cannot be used.
    pub fn of(
        &self,
        fingers: &[[f64; HAND_JOINTS]],
        held: Option<(usize, Isometry3<f64>)>,
    ) -> Result<CollisionModel, RobotError> {
        let model = self.mechanism.with_moving_fingers(&self.hand, fingers)?;
        Ok(match held {
            None => model,
            Some((kind, in_palm)) => {
                let (solid, centre) = coact_workplace::solid(self.shapes[kind]);
                model.holding(&self.mechanism, "the held part", solid, &(in_palm * centre))
            }
        })
    }
}
