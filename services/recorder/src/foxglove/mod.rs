//! What Foxglove shows of a run without knowing anything of ours: the robot, the parts and the person as frames and shapes, the
//! joints, and what happened in words. Each message has a schema that Foxglove knows by name.

mod joints;
mod log;
mod scene;
mod schemas;
mod transforms;
mod values;

pub(crate) use joints::JointStates;
pub(crate) use log::RunLogs;
pub(crate) use scene::Scene;
pub(crate) use transforms::Transforms;
