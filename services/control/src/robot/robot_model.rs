use super::{FingerShape, GripTable};
use crate::ControlError;
use crate::state::{FINGER_JOINTS, Skill};
use coact_drive::FASTEST_SETPOINT;
use coact_joint_task::{Kind, Task};
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_motion::{Capsule, Plan};
use coact_robot::{HAND_JOINTS, JointLimits, Robot};
use nalgebra::Isometry3;

/// Clear width of the resting hand, m. Chosen by hand: half open looks relaxed, and opens in half the time.
const RELAXED: f64 = 0.10;
/// Clear width of the hand that steadies or points, m. Chosen by hand: nearly closed, yet the finger ends do not touch.
const SLENDER: f64 = 0.03;

/// The robot in terms of messages: all [`JOINTS`] angles, the last of which is reserved.
#[derive(Debug, Clone)]
pub(crate) struct RobotModel {
    pub robot: Robot,
    pub grips: GripTable,
    /// Bounding capsules of the kinds of parts, in the parts' own frames.
    pub part_capsules: Vec<Capsule>,
    /// Angles of the hand's joints (message order) at rest and pressed together, rad. They are computed beforehand: the
    /// search for an opening of given width takes longer than the rest of a servo step.
    relaxed: [f64; HAND_JOINTS],
    slender: [f64; HAND_JOINTS],
}

// Whatever the drive lets through is faster than any plan: none is broken off.
const _: () = assert!(Plan::FASTEST < FASTEST_SETPOINT);

impl RobotModel {
    /// # Errors
    /// [`ControlError::Ungraspable`] when the hand cannot grasp a part of the task.
    pub fn new(robot: Robot, task: &Task) -> Result<Self, ControlError> {
        let clear = |width: f64| robot.hand.posture(robot.hand.base_for_width(width));
        let (relaxed, slender) = (clear(RELAXED), clear(SLENDER));
        let part_capsule = |kind: &Kind| {
            coact_workplace::upright(&kind.name, kind.shape, &Isometry3::identity()).bounding_capsule
        };
        let part_capsules = task.kinds.iter().map(part_capsule).collect();
        Ok(Self { grips: GripTable::new(&robot.hand, task)?, part_capsules, relaxed, slender, robot })
    }

    /// Limits in message order; the reserved joint stays at zero.
    pub fn limits(&self) -> [JointLimits; JOINTS] {
        coact_drive::joint_limits(&self.robot)
    }

    /// Angles of the hand's joints (message order) for what the fingers do, rad.
    pub fn hand_angles(&self, shape: FingerShape) -> [f64; HAND_JOINTS] {
        match shape {
            FingerShape::Relaxed => self.relaxed,
            FingerShape::Around(kind) => self.grips.open_around(kind),
            FingerShape::Closed(grip) => self.grips.all()[grip].closed,
            FingerShape::Open(grip) => self.grips.all()[grip].open,
            FingerShape::Slender => self.slender,
        }
    }

    /// The same with the reserved joint, as the servo takes them.
    pub fn finger_angles(&self, shape: FingerShape) -> [f64; FINGER_JOINTS] {
        let mut angles = [0.0; FINGER_JOINTS];
        angles[..HAND_JOINTS].copy_from_slice(&self.hand_angles(shape));
        angles
    }

    /// What the fingers do on the way to a skill's goal, with a part in `grip` or none.
    pub fn on_the_way(&self, skill: Skill, kind: Option<usize>, grip: Option<usize>) -> FingerShape {
        FingerShape::on_the_way(skill, kind, grip, |kind| self.grips.received(kind))
    }

    /// Angles at rest.
    pub fn park(&self) -> [f64; JOINTS] {
        let mut angles = [0.0; JOINTS];
        angles[..ARM_JOINTS].copy_from_slice(&self.robot.park);
        angles[ARM_JOINTS..].copy_from_slice(&self.finger_angles(FingerShape::Relaxed));
        angles
    }

    /// Measured angles as a place to start from: within the limits, and at rest where nothing usable was measured.
    pub fn start_from(&self, measured: &[f64; JOINTS]) -> [f64; JOINTS] {
        let (park, limits) = (self.park(), self.limits());
        std::array::from_fn(|joint| {
            let angle = if measured[joint].is_finite() { measured[joint] } else { park[joint] };
            angle.clamp(limits[joint].lower, limits[joint].upper)
        })
    }
}
