//! The person's hand: keypoints bridged over drop-outs, filtered, and its movement from stillness to stillness.

mod arm_estimate;
mod hand_memory;
mod motion;
mod view_frame;

pub(crate) use hand_memory::HandMemory;
pub(crate) use motion::Motion;
pub(crate) use view_frame::ViewFrame;
