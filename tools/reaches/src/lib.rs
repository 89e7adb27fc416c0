//! Recorded reaches of real people, replayed through perception and the field network: how often, and how long before
//! contact, the right goal is inferred; and the training of the model of preshaping that this needs.
//!
//! Whoever is tested is unseen: the model comes from the other people of the folder, or from a file. Labels of the
//! tested person are looked at only after all decisions have been taken.

mod evaluation;
mod extraction;
mod inference_trace;
mod level_fit;
mod movement_fit;
mod parallel;
mod reach_outcome;
mod reaches_report;
mod subject;
mod training;

pub use evaluation::Evaluation;
pub use inference_trace::InferenceTrace;
pub use reach_outcome::{FRACTIONS, GoalDecision, ReachOutcome};
pub use reaches_report::{FIRST, ReachTally, ReachesReport};
pub use subject::Subject;
pub use training::{TrainError, leave_one_out, model_file, train};
