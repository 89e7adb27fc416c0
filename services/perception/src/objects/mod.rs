//! Parts: where each lies, who has it, and which places are empty.

mod hands;
mod holders;
mod part_track;
mod part_tracks;
mod sight;
mod task_places;

pub(crate) use hands::{Hands, PersonHand};
pub(crate) use holders::TOUCH;
pub(crate) use part_track::PartTrack;
pub(crate) use part_tracks::PartTracks;
pub(crate) use sight::Sight;
pub(crate) use task_places::TaskPlaces;
