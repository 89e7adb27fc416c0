use super::fitting::Fitting;
use super::person_model::PersonModel;
use super::reach_record::ReachRecord;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::Implausible;

/// What perception remembers about preshaping.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct PreshapeState {
    /// The present reach.
    pub reach: ReachRecord,
    /// The person's earlier reaches and hand.
    pub person: PersonModel,
    /// The mixture that is being fitted to them.
    pub fitting: Fitting,
}

impl PreshapeState {
    /// Refuses what is no state of it.
    pub fn check(&self) -> Result<(), Implausible> {
        self.reach.check()?;
        self.person.check()?;
        self.fitting.check()
    }
}
