use super::schemas;
use super::values::time;
use coact_messages::SensorSample;
use coact_robot::Robot;
use coact_run_recording::JsonSchema;
use serde_json::{Value, json};

/// The angles of arm and hand, as `foxglove.JointStates`.
pub(crate) struct JointStates {
    names: Vec<String>,
    pub schema: JsonSchema,
}

impl JointStates {
    pub const TOPIC: &str = "/joints";

    pub fn new(robot: &Robot) -> Self {
        let joints = robot.arm().joints.iter().chain(&robot.hand.joints);
        Self { names: joints.map(|joint| joint.name.clone()).collect(), schema: schemas::joint_states() }
    }

    /// At `ns` since 1970.
    pub fn of(&self, sample: &SensorSample, ns: u64) -> Value {
        let measured = sample.joints.position.iter().zip(&sample.joints.velocity);
        let joint = |(name, (position, velocity)): (&String, (&f64, &f64))| json!({ "name": name, "position": position, "velocity": velocity });
        let joints: Vec<_> = self.names.iter().zip(measured).map(joint).collect();
        json!({ "timestamp": time(ns), "joints": joints })
    }
}
