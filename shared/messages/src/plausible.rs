use crate::{Header, MAX_KINDS, MAX_SUBGOALS, NONE};

/// What can be judged of a message without knowing its task: numbers that are finite and of a size that they can have,
/// fractions, counts, indices, texts.
///
/// Ports refuse a message that is not plausible, so that no stage sees it. Words of a stage's own state are judged where
/// they are read, by `coact-stage-state`.
pub trait Plausible {
    /// Looks for a field that is not what it can be.
    ///
    /// # Errors
    /// The first such field.
    fn check(&self) -> Result<(), Flaw>;
}

/// A field of a message that is not what it can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{field} is implausible, expected {expected}")]
pub struct Flaw {
    /// Its name.
    pub field: &'static str,
    /// What was expected.
    pub expected: &'static str,
}

/// Nothing in a scene is farther away than this, m: a part that falls off the table is put back long before.
const FARTHEST: f64 = 1e3;
/// Nothing in a scene is faster than this, m/s: a part that has fallen that far.
const FASTEST: f64 = 1e3;
/// How much the square of a quaternion's length may differ from 1: sums of many small turns, and single precision.
const QUATERNION: f64 = 0.1;

/// Refuses `field` when `condition` does not hold.
pub(crate) fn ensure(condition: bool, field: &'static str, expected: &'static str) -> Result<(), Flaw> {
    if condition { Ok(()) } else { Err(Flaw { field, expected }) }
}

/// Refuses `field` when one of its numbers is farther from zero than `most`, or is none.
pub(crate) fn bounded(field: &'static str, numbers: &[f64], most: f64) -> Result<(), Flaw> {
    ensure(are_within(numbers, -most, most), field, "finite numbers of a size that it can have")
}

/// Refuses evidence, confidences and other fractions that are none.
pub(crate) fn fractions(field: &'static str, numbers: &[f64]) -> Result<(), Flaw> {
    ensure(are_within(numbers, 0.0, 1.0), field, "numbers between 0 and 1")
}

/// Refuses coordinates of a place that is nowhere near.
pub(crate) fn places(field: &'static str, numbers: &[f64]) -> Result<(), Flaw> {
    bounded(field, numbers, FARTHEST)
}

/// Refuses velocities that nothing has.
pub(crate) fn velocities(field: &'static str, numbers: &[f64]) -> Result<(), Flaw> {
    bounded(field, numbers, FASTEST)
}

/// Refuses orientations that are no rotation, unless they are zero: not known.
pub(crate) fn orientations(field: &'static str, quaternions: &[[f64; 4]]) -> Result<(), Flaw> {
    let square = |[x, y, z, w]: &[f64; 4]| x * x + y * y + z * z + w * w;
    let is_rotation = |length: f64| (length == 0.0) | ((length - 1.0).abs() <= QUATERNION);
    let are = quaternions.iter().fold(true, |all, own| all & is_rotation(square(own)));
    ensure(are, field, "quaternions of length 1")
}

/// Refuses an index that is not below `count`.
pub(crate) fn index(field: &'static str, index: u32, count: usize) -> Result<(), Flaw> {
    ensure((index as usize) < count, field, "an index of something that can be")
}

/// Refuses an index that is neither below `count` nor [`NONE`].
pub(crate) fn optional(field: &'static str, found: u32, count: usize) -> Result<(), Flaw> {
    if found == NONE { Ok(()) } else { index(field, found, count) }
}

/// Refuses a kind of part that no task can name.
pub(crate) fn kind(field: &'static str, found: u32) -> Result<(), Flaw> {
    index(field, found, MAX_KINDS)
}

/// Refuses a subgoal that no task can name.
pub(crate) fn subgoal(field: &'static str, found: u32) -> Result<(), Flaw> {
    optional(field, found, MAX_SUBGOALS)
}

/// Refuses a cycle that comes after the message's own. In cycle 0 the network counts from 1.
pub(crate) fn not_after(field: &'static str, header: &Header, cycles: &[u64]) -> Result<(), Flaw> {
    let last = header.cycle.max(1);
    let are = cycles.iter().fold(true, |all, cycle| all & (*cycle <= last));
    ensure(are, field, "no cycle after the message's own")
}

/// Without an early end, so that several numbers are compared at once: a field frame has some 5000.
fn are_within(numbers: &[f64], least: f64, most: f64) -> bool {
    numbers.iter().fold(true, |all, number| all & (*number >= least) & (*number <= most))
}
