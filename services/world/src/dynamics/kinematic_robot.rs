use super::influence::Influence;
use super::joints::Joints;
use crate::parts::Parts;
use coact_period::PERIOD_S;
use coact_robot::ROBOT_JOINTS;

/// Time constant of the servo, s: joints follow their setpoints with this lag. Chosen by hand, of the
/// size of good servos' lags; not sensitive.
const LAG: f64 = 0.004;

/// Joints that follow their setpoints, and parts that rest where they are put: no contact forces.
#[derive(Debug, Clone)]
pub(crate) struct KinematicRobot {
    /// Fraction of the distance to the setpoint that is covered in one cycle.
    gain: f64,
}

impl KinematicRobot {
    pub fn new() -> Self {
        Self { gain: 1.0 - (-PERIOD_S / LAG).exp() }
    }

    pub fn advance(&self, influence: &Influence, joints: &mut Joints, parts: &mut Parts) {
        let Influence { setpoints, stop, .. } = *influence;
        let before = joints.position;
        if let Some(setpoints) = setpoints {
            for (joint, setpoint) in setpoints[..ROBOT_JOINTS].iter().enumerate() {
                let goal = setpoint.position.min(stop.limit(joint));
                joints.position[joint] += self.gain * (goal - joints.position[joint]);
            }
        }
        joints.velocity = std::array::from_fn(|joint| (joints.position[joint] - before[joint]) / PERIOD_S);
        parts.rest_free(influence.task);
    }
}
