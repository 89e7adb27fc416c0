use super::{FEATURES, Features, Pace, SNAPSHOTS};
use bytemuck::{Pod, Zeroable};

/// Share of the way to the slow phase that a person's tempo is measured by. People differ in how they arrive; this far,
/// they are alike: contact comes at 1.8 times it, within 10 %.
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
    pub pace: Pace,
    /// Features at each phase.
    pub features: [Features; SNAPSHOTS.len()],
}

impl ReachRecord {
    /// Whether all phases have passed.
    pub fn is_complete(&self) -> bool {
        self.passed as usize == SNAPSHOTS.len()
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
