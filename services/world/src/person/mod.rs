//! The human partner: what the person means to do, and how the hand moves to do it.

mod actor;
mod hand_model;
mod hand_pose;
mod intention;
mod memory;
mod movement;
mod movements;
mod plan;
mod profile;
mod script;
mod synthetic;

pub(crate) use actor::{Person, Surroundings};
pub(crate) use hand_model::HandModel;
pub(crate) use hand_pose::HandPose;

pub(crate) use memory::{Errand, PersonMemory, Stage};
pub(crate) use movement::Movement;
pub(crate) use plan::Plan;
pub use script::Script;
