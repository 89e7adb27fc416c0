use coact_messages::{ARM_JOINTS, JOINTS};
use coact_robot::{JointLimits, Posture, ROBOT_JOINTS, Robot};

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

    /// All angles for an arm posture and what the fingers do.
    pub fn angles(&self, arm: &Posture, fingers: Fingers) -> [f64; JOINTS] {
        let hand = &self.robot.hand;
        let fingers = match fingers {
            Fingers::Relaxed => hand.posture(hand.base_for_width(RELAXED)),
            Fingers::Around(width) => hand.grasp(width, OPENING).angles,
            Fingers::On(width) => hand.grasp(width, -SQUEEZE * width).angles,
            Fingers::Slender => hand.posture(hand.base_for_width(SLENDER)),
            Fingers::HeldOut => hand.posture(HELD_OUT),
        };
        let mut angles = [0.0; JOINTS];
        angles[..ARM_JOINTS].copy_from_slice(arm);
        angles[ARM_JOINTS..ROBOT_JOINTS].copy_from_slice(&fingers);
        angles
    }

    /// Angles at rest.
    pub fn park(&self) -> [f64; JOINTS] {
        self.angles(&self.robot.park, Fingers::Relaxed)
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
