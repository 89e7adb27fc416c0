use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Implausible, finite};

/// What has happened in the present phase of a skill.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct PhaseProgress {
    /// Cycles since the phase began.
    pub age: u64,
    /// Cycles for which touch has said what is waited for: a part is present, or lost.
    pub touched: u64,
    /// Cycles for which the person's hand has been where it is waited for.
    pub met: u64,
    /// Camera frames that have shown the part between the fingers, once they had closed.
    pub sightings: u64,
    /// Cycle of the newest one that has shown it, while they closed as well; 0 before.
    pub seen_in: u64,
    /// Sum of the places at which they have shown it, in the palm's frame, m.
    pub seen: [f64; 3],
}

impl PhaseProgress {
    pub fn check(&self) -> Result<(), Implausible> {
        finite("skill.progress.seen", &self.seen)
    }
}
