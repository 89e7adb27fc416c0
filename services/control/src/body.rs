use crate::errand::Errand;
use crate::memory::FINGER_JOINTS;
use crate::places::Places;
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_robot::{HAND_JOINTS, JointLimits, Robot};

/// Gap between an open finger and the part that it opens around, m.
const OPENING: f64 = 0.01;
/// How far into a part each finger is told to close, as a share of its width: what makes them press.
const SQUEEZE: f64 = 0.3;
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
    /// Open wider than something this wide, m.
    Around(f64),
    /// Closed on something this wide, m.
    On(f64),
    /// Together, to press on something or to point.
    Slender,
    /// Wide open, held out.
    HeldOut,
}

/// The robot in terms of messages: all [`JOINTS`] angles, the last of which is reserved.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub robot: Robot,
}

impl Body {
    /// Limits in message order; the reserved joint stays at zero.
    pub fn limits(&self) -> [JointLimits; JOINTS] {
        let reserved =
            JointLimits { lower: -1.0, upper: 1.0, velocity: 1.0, effort: 1.0, acceleration: 1.0, jerk: 1.0 };
        let own = self.robot.limits();
        std::array::from_fn(|joint| own.get(joint).copied().unwrap_or(reserved))
    }

    /// Angles of the hand's joints (message order) for what the fingers do.
    pub fn fingers(&self, fingers: Fingers) -> [f64; HAND_JOINTS] {
        let hand = &self.robot.hand;
        match fingers {
            Fingers::Relaxed => hand.posture(hand.base_for_width(RELAXED)),
            Fingers::Around(width) => hand.grasp(width, OPENING).angles,
            Fingers::On(width) => hand.grasp(width, -SQUEEZE * width).angles,
            Fingers::Slender => hand.posture(hand.base_for_width(SLENDER)),
            Fingers::HeldOut => hand.posture(HELD_OUT),
        }
    }

    /// The same with the reserved joint, as the servo takes them.
    pub fn finger_joints(&self, fingers: Fingers) -> [f64; FINGER_JOINTS] {
        let mut angles = [0.0; FINGER_JOINTS];
        angles[..HAND_JOINTS].copy_from_slice(&self.fingers(fingers));
        angles
    }

    /// What the fingers do on the way to an errand's goal.
    pub fn on_the_way(
        &self,
        errand: Errand,
        kind: Option<usize>,
        held: Option<usize>,
        places: &Places,
    ) -> Fingers {
        let width = |kind: usize| places.width(kind);
        match (errand, held, kind) {
            (_, Some(held), _) => Fingers::On(width(held)),
            (Errand::Take | Errand::Receive, _, Some(kind)) => Fingers::Around(width(kind)),
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
