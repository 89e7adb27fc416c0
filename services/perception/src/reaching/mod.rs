//! Where the hand is going: how well a movement so far fits a reach to a place, by what is known of people's reaches.
//!
//! A reach is described as the way of the middle between thumb and index finger, against the straight line from where it began to where
//! it ends: along it and aside, both in units of its length, over the time since a tenth of it was covered, in units of the time from there
//! to contact. So described, people's reaches of all lengths and directions are alike. They are taken to be Gaussian:
//!
//! ```text
//! way(time) = mean(time) + sum over modes of coefficient * mode(time) + scatter
//! ```
//!
//! with independent coefficients of unit variance: a probabilistic movement primitive (Paraschos et al. 2013), whose mean and modes are the
//! principal components of recorded reaches. For a place that the reach might end at, all but its duration is known from what was seen of
//! it; the duration is integrated over, and so are the coefficients, in closed form.
//!
//! How a person's own reaches differ from other people's is learned: when a part is in the hand, it is known where the reach has led, and so
//! what its coefficients were.

mod hand_path;
mod likelihoods;
mod movement_model;
mod movement_reader;
mod person_movement;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests;

pub use movement_model::{CURVE_BEGINS, CURVE_KNOTS, CURVE_MODES, CURVE_SPACING, MovementModel, TENTH};

pub(crate) use hand_path::HandPath;
pub(crate) use likelihoods::{HANDOVER, Likelihoods, PLACES};
pub(crate) use movement_reader::MovementReader;
pub(crate) use person_movement::PersonMovement;
