//! The person's hand: keypoints bridged over drop-outs, joints filtered, and its movement from stillness to stillness.

mod arm_estimate;
mod hand_movement;
mod keypoints;
mod tracked_hand;
mod tracked_joint;
mod view_frame;

pub(crate) use hand_movement::HandMovement;
pub(crate) use keypoints::BELIEVED;
pub(crate) use tracked_hand::{TrackedHand, USABLE};
pub(crate) use view_frame::ViewFrame;
