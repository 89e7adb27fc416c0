//! What the robot's sensors make of the world: delay, noise, and gaps.

mod depth_camera;
mod encoders;
mod frame_rate;
mod lines_of_sight;
mod recogniser;
mod tracker;

pub(crate) use encoders::read_joints;
pub(crate) use lines_of_sight::LinesOfSight;
#[cfg(test)]
pub(crate) use recogniser::is_seen;
pub(crate) use recogniser::recognise;
pub(crate) use tracker::{Capture, TrackerState, is_captured, track};
