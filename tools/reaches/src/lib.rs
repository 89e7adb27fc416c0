//! Recorded reaches of real people, replayed through perception and the field network: how often, and how long before
//! contact, the right goal is inferred; and the training of the model of preshaping that this needs.
//!
//! Whoever is tested is unseen: the model comes from the other people of the folder, or from a file. Labels of the
//! tested person are looked at only after all decisions have been taken.

mod camera;
mod evaluation;
mod extraction;
mod fit;
mod order;
mod outcome;
mod playback;
mod replay;
mod report;
mod training;

pub use camera::METRES_PER_PIXEL;
pub use evaluation::{Evaluation, evaluate};
pub use order::Order;
pub use outcome::{FRACTIONS, Outcome};
pub use report::{Report, Tally};
pub use training::{TrainError, model_file, train};
