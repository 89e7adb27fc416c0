//! Campaigns and encounters, judged.

mod campaign;
mod encounters;
