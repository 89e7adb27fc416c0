//! How large the object is that a hand prepares for, read from its shape on the way.
//!
//! People shape their hand to the object while they reach (Jeannerod 1984), but each in his own way: features of one
//! person's hand say little about another's. So the model is hierarchical. A feature vector seen at a given phase of
//! the reach is
//!
//! ```text
//! features = mean of the size class + offset of the person + deviation of the person's class + scatter of the reach
//! ```
//!
//! all Gaussian, with covariances learned from other people. For the person at hand, the mixture of all classes is
//! fitted to the reaches so far, whose sizes nobody tells: their responsibilities, the classes' shares and the person's own
//! class means, by expectation maximisation under the learned priors. Everything happens along Fisher's discriminant.

mod blend;
mod classifier;
mod features;
mod fitting;
mod hierarchy;
mod model_error;
mod person_model;
mod preshape_model;
mod preshape_state;
mod progress;
mod reach_record;

pub use features::{FEATURES, Features};
pub use model_error::ModelError;
pub use preshape_model::{CLASSES, Level, PreshapeModel, READ, SNAPSHOTS, WHOLE, WHOLE_LENGTH};
pub use progress::Progress;
pub use reach_record::ReachRecord;

/// The last phase that is read, as an index into [`SNAPSHOTS`].
pub(crate) const LAST_READ: usize = READ - 1;

pub(crate) use classifier::Classifier;
pub(crate) use preshape_state::PreshapeState;
