use super::preshape_model::{CLASSES, READ};
use crate::plausible_cycle::cycle;
use bytemuck::{CheckedBitPattern, NoUninit, Pod, Zeroable};
use coact_stage_state::{Flag, Implausible, ensure, finite};

/// Reaches that are remembered: more tell nothing new of a hand, and older ones may be those of another person.
pub(crate) const REACHES: usize = 60;
/// Reaches that the usual tempo of people counts for: a first reach alone, perhaps hesitant, does not set the tempo. Chosen
/// by hand.
const PRIOR_REACHES: usize = 3;

/// One earlier reach, along the discriminants.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PastReach {
    /// As a whole.
    pub whole: f64,
    /// At each phase that is read on the way.
    pub phase: [f64; READ],
    /// Its tempo, s.
    pub tempo: f64,
}

/// One person's own class means at one phase, and how uncertain they are.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct OwnLevel {
    pub mean: [f64; CLASSES],
    pub variance: [f64; CLASSES],
}

/// What is known of this person: the last reaches, and what was learned from them.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct PersonModel {
    /// Reaches so far.
    pub count: u64,
    /// Usual tempo, s; 0 before the first reach.
    pub tempo: f64,
    /// Class means at each phase; valid once `adapted`.
    pub own: [OwnLevel; READ],
    /// Whether `own` is valid.
    pub adapted: Flag,
    /// The last reaches; the oldest is overwritten.
    ring: [PastReach; REACHES],
}

impl PersonModel {
    /// Refuses what is no state of it.
    pub fn check(&self) -> Result<(), Implausible> {
        cycle("preshape.person.count", self.count)?;
        ensure(self.tempo >= 0.0 && self.tempo.is_finite(), "preshape.person.tempo", "a time")?;
        for level in &self.own {
            finite("preshape.person.own", &level.mean)?;
            let variances = level.variance.iter().all(|variance| *variance >= 0.0 && variance.is_finite());
            ensure(variances, "preshape.person.own", "variances")?;
        }
        self.ring.iter().try_for_each(|reach| {
            finite("preshape.person.ring", &reach.phase)?;
            finite("preshape.person.ring", &[reach.whole, reach.tempo])
        })
    }

    /// The reaches that are remembered.
    pub fn past(&self) -> &[PastReach] {
        &self.ring[..(self.count as usize).min(REACHES)]
    }

    /// Remembers a reach; `usual` is the tempo of people.
    pub fn remember(&mut self, reach: PastReach, usual: f64) {
        self.ring[self.count as usize % REACHES] = reach;
        self.count += 1;
        self.tempo = self.median_tempo(usual);
    }

    /// Median tempo of the remembered reaches, and of a few usual ones.
    fn median_tempo(&self, usual: f64) -> f64 {
        let mut sorted = [usual; REACHES + PRIOR_REACHES];
        let past = self.past();
        for (slot, reach) in sorted.iter_mut().zip(past) {
            *slot = reach.tempo;
        }
        let sorted = &mut sorted[..past.len() + PRIOR_REACHES];
        sorted.sort_unstable_by(f64::total_cmp);
        let middle = sorted.len() / 2;
        if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) }
    }
}
