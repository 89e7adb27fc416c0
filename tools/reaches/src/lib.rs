//! Recorded reaches of real people, replayed through perception and the field network: how often, and how long before
//! contact, the right goal is inferred; and the training of the model of preshaping that this needs.
//!
//! Whoever is tested is unseen: the model comes from the other people of the folder, or from a file. Labels of the
//! tested person are looked at only after all decisions have been taken.

mod course;
mod evaluation;
mod extraction;
mod fit;
mod outcome;
mod report;
mod subject;
mod training;

pub use course::Course;
pub use evaluation::Evaluation;
pub use outcome::{FRACTIONS, Outcome};
pub use report::{Report, Tally};
pub use subject::Subject;
pub use training::{TrainError, model_file, train};
