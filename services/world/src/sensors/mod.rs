//! What the robot's sensors make of the world: delay, noise, and gaps.

mod encoders;
mod recogniser;
mod tracker;

pub(crate) use encoders::read_joints;
pub(crate) use recogniser::recognise;
pub(crate) use tracker::{Capture, TrackerState, track};

/// Whether a camera of `rate` Hz captures a frame after tick `last` and up to `tick`.
fn is_frame_due(rate: u64, last: Option<u64>, tick: u64) -> bool {
    last.is_none_or(|last| tick * rate / 1000 != last * rate / 1000)
}
