//! The human partner: what the person means to do, and how the hand moves to do it.

mod actor;
mod erring;
mod force;
mod hand_model;
mod hand_pose;
mod intention;
mod manner;
mod memory;
mod movement;
mod movements;
mod plan;
mod playback;
mod profile;
mod rates;
mod recorded;
mod screen;
mod script;
mod script_file;
mod script_source;
mod staging_file;
mod synthetic;
mod waiting;

pub(crate) use actor::{Person, Surroundings};
pub(crate) use hand_model::{FOREARM, HandModel};
pub(crate) use hand_pose::HandPose;

pub(crate) use intention::{Choice, Intention, View};
pub(crate) use manner::Manner;
pub(crate) use memory::{Errand, PersonMemory, Stage};
pub(crate) use movement::Movement;
pub(crate) use plan::Plan;
#[cfg(test)]
pub(crate) use profile::FINGERS;
pub use rates::Rates;
pub use recorded::Recorded;
pub use script::Script;
