use super::model::{CLASSES, READ};
use bytemuck::{Pod, Zeroable};

/// Reaches that are remembered.
pub(crate) const REACHES: usize = 60;
/// Reaches that the usual tempo of people counts for.
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
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Person {
    /// Reaches so far.
    pub count: u64,
    /// Usual tempo, s; 0 before the first reach.
    pub tempo: f64,
    /// Class means at each phase; valid once `adapted`.
    pub own: [OwnLevel; READ],
    /// 1 once `own` is valid.
    pub adapted: u64,
    /// The last reaches; the oldest is overwritten.
    ring: [PastReach; REACHES],
}

impl Person {
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
