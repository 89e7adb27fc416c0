//! Parts: where each lies, who has it, and which places are empty.

mod holders;
mod objects_memory;
mod part_track;
mod places;
mod surroundings;

pub(crate) use holders::TOUCH;
pub(crate) use objects_memory::ObjectsMemory;
pub(crate) use part_track::PartTrack;
pub(crate) use places::Places;
pub(crate) use surroundings::{PersonHand, Surroundings};
