//! The suite of movements by which the planner is measured: randomised cases of several scenarios, the quality of a planned
//! movement as an observer sees it, and a long RRT-Connect search that tells which failures had a solution.

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
