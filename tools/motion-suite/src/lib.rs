//! The suite of movements by which the planner is measured: randomised cases, what a movement looks like from outside,
//! and a long sampling search as the judge of what could have been solved.

mod case;
mod chart;
mod measurement;
mod movement_page;
mod quality;
mod scenario;
mod setting;

pub use case::Case;
pub use measurement::{Measurement, Outcome, measure};
pub use movement_page::MovementPage;
pub use quality::{FAR, Quality, path};
pub use scenario::Scenario;
pub use setting::Setting;
