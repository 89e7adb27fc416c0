use crate::ControlError;
use crate::errand::Errand;
use crate::holds::Holds;
use crate::memory::FINGER_JOINTS;
use coact_joint_task::{Kind, Task};
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_motion::Capsule;
use coact_robot::{HAND_JOINTS, JointLimits, Robot};
use nalgebra::Isometry3;

/// Clear width of the resting hand, m.
const RELAXED: f64 = 0.10;
/// Clear width of the hand that steadies or points, m.
const SLENDER: f64 = 0.03;
/// Base angle of the fingers of the hand that is held out, rad.
const HELD_OUT: f64 = 0.6;

/// What the fingers do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fingers {
    /// Resting, half open.
    Relaxed,
    /// Open around a kind of part, whichever way it is taken.
    Around(usize),
    /// Closed on a part in one of the [`Holds`].
    On(usize),
    /// Open around it in that one.
    Off(usize),
    /// Together, to press on something or to point.
    Slender,
    /// Wide open, held out.
    HeldOut,
}

/// The robot in terms of messages: all [`JOINTS`] angles, the last of which is reserved.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub robot: Robot,
    pub holds: Holds,
    /// Capsules around the kinds of parts, in the parts' own frames.
    pub hulls: Vec<Capsule>,
    /// Angles of the hand's joints (message order) at rest and pressed together, rad: known beforehand, for the servo has
    /// no time to look for them.
    relaxed: [f64; HAND_JOINTS],
    slender: [f64; HAND_JOINTS],
}

impl Body {
    /// # Errors
    /// [`ControlError::Ungraspable`] when the hand cannot hold a part of the task.
    pub fn new(robot: Robot, task: &Task) -> Result<Self, ControlError> {
        let clear = |width: f64| robot.hand.posture(robot.hand.base_for_width(width));
        let (relaxed, slender) = (clear(RELAXED), clear(SLENDER));
        let hull = |kind: &Kind| {
            coact_workplace::upright(&kind.name, kind.shape, &Isometry3::identity()).bounding_capsule
        };
        let hulls = task.kinds.iter().map(hull).collect();
        Ok(Self { holds: Holds::new(&robot.hand, task)?, hulls, relaxed, slender, robot })
    }

    /// Limits in message order; the reserved joint stays at zero.
    pub fn limits(&self) -> [JointLimits; JOINTS] {
        let reserved =
            JointLimits { lower: -1.0, upper: 1.0, velocity: 1.0, effort: 1.0, acceleration: 1.0, jerk: 1.0 };
        let own = self.robot.limits();
        std::array::from_fn(|joint| own.get(joint).copied().unwrap_or(reserved))
    }

    /// Angles of the hand's joints (message order) for what the fingers do.
    pub fn fingers(&self, fingers: Fingers) -> [f64; HAND_JOINTS] {
        match fingers {
            Fingers::Relaxed => self.relaxed,
            Fingers::Around(kind) => self.holds.around(kind),
            Fingers::On(hold) => self.holds.all()[hold].closed,
            Fingers::Off(hold) => self.holds.all()[hold].open,
            Fingers::Slender => self.slender,
            Fingers::HeldOut => self.robot.hand.posture(HELD_OUT),
        }
    }

    /// The same with the reserved joint, as the servo takes them.
    pub fn finger_joints(&self, fingers: Fingers) -> [f64; FINGER_JOINTS] {
        let mut angles = [0.0; FINGER_JOINTS];
        angles[..HAND_JOINTS].copy_from_slice(&self.fingers(fingers));
        angles
    }

    /// What the fingers do on the way to an errand's goal, with a part in `hold` or none.
    pub fn on_the_way(&self, errand: Errand, kind: Option<usize>, hold: Option<usize>) -> Fingers {
        match (errand, hold, kind) {
            (_, Some(hold), _) => Fingers::On(hold),
            (Errand::Take, _, Some(kind)) => Fingers::Around(kind),
            (Errand::Receive, _, Some(kind)) => Fingers::Off(self.holds.received(kind)),
            (Errand::Ask, ..) => Fingers::HeldOut,
            (Errand::Steady | Errand::Point, ..) => Fingers::Slender,
            _ => Fingers::Relaxed,
        }
    }

    /// Angles at rest.
    pub fn park(&self) -> [f64; JOINTS] {
        let mut angles = [0.0; JOINTS];
        angles[..ARM_JOINTS].copy_from_slice(&self.robot.park);
        angles[ARM_JOINTS..].copy_from_slice(&self.finger_joints(Fingers::Relaxed));
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
