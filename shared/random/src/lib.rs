//! Random numbers that depend on the seed, the purpose and the tick alone.
//!
//! A generator that is carried on from tick to tick would be state, and a killed process would lose it. Here each
//! [`Stream`] makes a fresh generator for each tick, so that a resumed run draws what the run would have drawn:
//!
//! ```
//! use coact_random::{RandomStreams, Stream};
//! use rand::RngExt;
//!
//! let draw = |seed, stream, tick| RandomStreams::new(seed).at(stream, tick).random::<u64>();
//! assert_eq!(draw(1, Stream::Choice, 42), draw(1, Stream::Choice, 42));
//! assert_ne!(draw(1, Stream::Choice, 42), draw(1, Stream::Tracker, 42));
//! assert_ne!(draw(1, Stream::Choice, 42), draw(1, Stream::Choice, 43));
//! ```

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg32;
use std::ops::RangeInclusive;

/// What a random generator is for: one independent sequence each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub enum Stream {
    /// What the person chooses to do, and when.
    Choice = 1,
    /// How the person moves.
    Movement = 2,
    /// Noise and gaps of the hand tracker.
    Tracker = 3,
    /// Noise and gaps of the part recogniser.
    Recogniser = 4,
    /// Noise of the joint encoders.
    Encoders = 5,
    /// How a random partner varies its movements, and when it notices a mistake.
    Mistake = 6,
    /// When the tracker loses the hand of a random partner.
    Dropout = 7,
    /// When a random partner withdraws from a handover, or comes late.
    Handover = 8,
    /// Where a recorded arm is put.
    Placement = 9,
    /// Where parts lie when an assembly begins.
    Layout = 10,
    /// Whether, when and to what a random partner changes the mind in mid-reach.
    ChangeOfMind = 11,
    /// Where the person lays down a part that was mounted.
    FreePlace = 12,
    /// Whether a random partner puts back what was taken.
    Return = 13,
    /// Whether, where and for how long a random partner hesitates in mid-reach.
    Hesitation = 14,
    /// How this person differs from others.
    Habit = 15,
    /// When the recogniser takes a part for one of another kind.
    Mistaking = 16,
    /// Along which recorded way the person carries, gives or withdraws.
    Way = 17,
    /// Noise of the depth camera.
    Depth = 18,
    /// Noise and gaps of the hand tracker at the left arm.
    LeftTracker = 19,
    /// With which hand a random partner acts.
    Side = 20,
}

/// The random generators of one run.
#[derive(Debug, Clone, Copy)]
pub struct RandomStreams {
    seed: u64,
}

impl RandomStreams {
    /// The generators of the run with this seed.
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// A fresh generator for `stream` at `tick`.
    pub fn at(&self, stream: Stream, tick: u64) -> Pcg32 {
        Pcg32::seed_from_u64(scramble(self.seed ^ scramble(tick ^ scramble(stream as u64))))
    }
}

/// Whether `tick` falls into a burst: something that happens at most once in each `interval` of ticks, there with this probability, and lasts so
/// many ticks. `rng` is the generator of the interval, the same at each of its ticks.
pub fn is_in_burst<R: Rng>(
    rng: &mut R,
    probability: f64,
    tick: u64,
    interval: u64,
    lasts: RangeInclusive<u64>,
) -> bool {
    let happens = rng.random_bool(probability);
    let length = rng.random_range(lasts);
    let begins = rng.random_range(0..=interval - length);
    happens && (begins..begins + length).contains(&(tick % interval))
}

/// Finaliser of SplitMix64 (Steele, Lea and Flood 2014): neighbouring numbers become unrelated ones.
fn scramble(number: u64) -> u64 {
    let mut mixed = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}
