use super::schemas;
use super::values::{WORLD, parts, point, quaternion, time};
use coact_messages::SensorSample;
use coact_robot::Robot;
use coact_run_recording::JsonSchema;
use nalgebra::Isometry3;
use serde_json::{Value, json};

/// The frames of the robot's links, as `foxglove.FrameTransforms`.
pub(crate) struct Transforms {
    robot: Robot,
    pub schema: JsonSchema,
}

impl Transforms {
    pub const TOPIC: &str = "/tf";

    pub fn new(robot: Robot) -> Self {
        Self { robot, schema: schemas::frame_transforms() }
    }

    /// At `ns` since 1970.
    pub fn of(&self, sample: &SensorSample, ns: u64) -> Value {
        let (arm, posture) = (self.robot.arm(), &sample.joints.position);
        let links = arm.joints.iter().enumerate();
        let links = links.map(|(index, joint)| (joint.name.as_str(), arm.frame(posture, index)));
        let frames = links.chain([("palm", arm.palm(posture))]);
        let transform = |(name, frame): (&str, Isometry3<f64>)| {
            let (at, turn) = parts(&frame);
            json!({
                "timestamp": time(ns),
                "parent_frame_id": WORLD,
                "child_frame_id": name,
                "translation": point(&at),
                "rotation": quaternion(&turn),
            })
        };
        json!({ "transforms": frames.map(transform).collect::<Vec<_>>() })
    }
}
