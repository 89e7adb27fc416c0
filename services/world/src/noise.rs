use rand::SeedableRng;
use rand_pcg::Pcg32;

/// What a random generator is for: one independent sequence each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub(crate) enum Stream {
    Choice = 1,
    Movement = 2,
    Tracker = 3,
    Recogniser = 4,
    Encoders = 5,
    Mistake = 6,
    Dropout = 7,
    Handover = 8,
}

/// Randomness that depends on the seed, the purpose and the tick alone, so that there is no generator state to
/// lose when the process is killed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Noise {
    seed: u64,
}

impl Noise {
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// A fresh generator for `stream` at `tick`.
    pub fn at(&self, stream: Stream, tick: u64) -> Pcg32 {
        Pcg32::seed_from_u64(scramble(self.seed ^ scramble(tick ^ scramble(stream as u64))))
    }
}

/// Finaliser of SplitMix64 (Steele, Lea and Flood 2014): neighbouring numbers become unrelated ones.
fn scramble(number: u64) -> u64 {
    let mut mixed = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}
