use coact_messages::JOINTS;
use coact_robot::{JointLimits, Robot};

/// The reserved joint of a message: it stays at zero.
const RESERVED: JointLimits =
    JointLimits { lower: -1.0, upper: 1.0, velocity: 1.0, effort: 1.0, acceleration: 1.0, jerk: 1.0 };

/// The fraction of a joint's speed limit that setpoints may reach. Chosen by hand: movements are planned for less; the joints
/// follow with some overshoot, and encoders scatter, where the limit itself is never to be exceeded.
pub const FASTEST_SETPOINT: f64 = 0.99;

/// Limits of a robot's joints for their setpoints, in the order of the messages.
pub fn joint_limits(robot: &Robot) -> [JointLimits; JOINTS] {
    let own = robot.limits();
    let kept = |limits: JointLimits| JointLimits { velocity: FASTEST_SETPOINT * limits.velocity, ..limits };
    std::array::from_fn(|joint| own.get(joint).copied().map_or(RESERVED, kept))
}
