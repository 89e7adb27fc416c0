//! What the robot's sensors make of the world: delay, noise, and gaps.

mod encoders;
mod frame_rate;
mod recogniser;
mod tracker;

pub(crate) use encoders::read_joints;
pub(crate) use recogniser::recognise;
pub(crate) use tracker::{Capture, TrackerState, track};
