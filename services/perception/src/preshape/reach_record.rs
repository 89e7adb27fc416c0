use super::{FEATURES, Features, Progress, SNAPSHOTS};
use crate::hand::HandMovement;
use crate::plausible_cycle::cycle;
use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, ensure, finite};

/// Fraction of the way to the slow phase by which a person's tempo is measured. People differ in how they arrive; this
/// far, they are alike: contact comes at 1.8 times the time that it takes, within 10 %.
pub(crate) const ON_THE_WAY: f64 = 0.8;

/// What is kept of one reach from rest: features at each phase of [`SNAPSHOTS`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct ReachRecord {
    /// Cycle of its onset; 0 while no reach is being recorded.
    pub onset: u64,
    /// Phases that have passed.
    pub passed: u64,
    /// Time from onset to 80 % of the way that was covered when the slow phase began, s; 0 before that.
    pub tempo: f64,
    /// Where the wrist lay before, m.
    pub departure: [f64; 3],
    /// When the wrist had covered how much of its way.
    pub progress: Progress,
    /// Features at each phase.
    pub features: [Features; SNAPSHOTS.len()],
}

impl ReachRecord {
    /// Whether it is this movement that is, or was, recorded.
    pub(crate) fn is_of(&self, movement: &HandMovement) -> bool {
        self.onset > 0 && movement.onset == self.onset
    }

    /// Whether all phases have passed.
    pub fn is_complete(&self) -> bool {
        self.passed as usize == SNAPSHOTS.len()
    }

    /// Refuses what is no record.
    pub(crate) fn check(&self) -> Result<(), Implausible> {
        ensure(
            self.passed as usize <= SNAPSHOTS.len(),
            "preshape.reach.passed",
            "no more phases than there are",
        )?;
        cycle("preshape.reach.onset", self.onset)?;
        finite("preshape.reach.tempo", &[self.tempo])?;
        finite("preshape.reach.departure", &self.departure)?;
        finite("preshape.reach.features", self.features.as_flattened())?;
        self.progress.check()
    }

    /// Begins to record.
    pub(crate) fn begin(&mut self, onset: u64, departure: [f64; 3]) {
        *self = Self { onset: onset.max(1), departure, ..Self::zeroed() };
    }

    pub(crate) fn is_recording(&self) -> bool {
        self.onset > 0 && !self.is_complete()
    }

    /// Takes in the features of one frame, at `phase` of the reach.
    pub(crate) fn advance(&mut self, phase: f64, features: &Features) {
        while let Some(due) = SNAPSHOTS.get(self.passed as usize)
            && phase >= *due
        {
            self.features[self.passed as usize] = *features;
            self.passed += 1;
        }
    }

    /// Features of the whole reach, one phase after the other.
    pub fn whole(&self) -> [f64; super::WHOLE_LENGTH] {
        std::array::from_fn(|index| self.features[super::WHOLE[index / FEATURES]][index % FEATURES])
    }
}
