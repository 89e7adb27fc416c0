use coact_messages::JOINTS;
use coact_robot::{JointLimits, Robot};

/// The reserved joint of a message: it stays at zero.
const RESERVED: JointLimits =
    JointLimits { lower: -1.0, upper: 1.0, velocity: 1.0, effort: 1.0, acceleration: 1.0, jerk: 1.0 };

/// Limits of a robot's joints in the order of the messages.
pub fn joint_limits(robot: &Robot) -> [JointLimits; JOINTS] {
    let own = robot.limits();
    std::array::from_fn(|joint| own.get(joint).copied().unwrap_or(RESERVED))
}
