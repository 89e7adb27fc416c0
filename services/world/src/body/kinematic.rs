use super::Joints;
use crate::parts::Parts;
use coact_joint_task::Task;
use coact_messages::Command;
use coact_robot::{ROBOT_JOINTS, Robot};

/// Time constant of the servo, s: joints follow their setpoints with this lag.
const LAG: f64 = 0.004;

/// Joints that follow their setpoints, and parts that rest where they are put: no contact forces.
#[derive(Debug, Clone)]
pub(crate) struct Kinematic {
    task: Task,
    coupling: f64,
    /// How much of the way to the setpoint is covered in one tick.
    gain: f64,
}

impl Kinematic {
    pub fn new(task: &Task, robot: &Robot) -> Self {
        Self { task: task.clone(), coupling: robot.hand.coupling, gain: 1.0 - (-1e-3 / LAG).exp() }
    }

    pub fn advance(
        &self,
        elapsed: u64,
        command: Option<&Command>,
        finger_stop: Option<f64>,
        joints: &mut Joints,
        parts: &mut Parts,
    ) {
        let before = joints.position;
        if let Some(command) = command {
            let gain = if elapsed == 1 { self.gain } else { 1.0 - (1.0 - self.gain).powi(elapsed as i32) };
            for joint in 0..ROBOT_JOINTS {
                let goal = self.stopped(joint, command.position[joint], finger_stop);
                joints.position[joint] += gain * (goal - joints.position[joint]);
            }
        }
        let seconds = 1e-3 * elapsed.max(1) as f64;
        for joint in 0..ROBOT_JOINTS {
            joints.velocity[joint] = (joints.position[joint] - before[joint]) / seconds;
        }
        parts.rest_free(&self.task);
    }

    /// The setpoint of a joint, as far as a part between the fingers lets it go.
    fn stopped(&self, joint: usize, goal: f64, finger_stop: Option<f64>) -> f64 {
        match (finger_stop, joint) {
            (Some(stop), 8..=10) => goal.min(stop),
            (Some(stop), 11..=13) => goal.min(stop * self.coupling),
            _ => goal,
        }
    }
}
