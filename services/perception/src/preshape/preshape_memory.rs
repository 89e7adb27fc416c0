use super::fitting::Fitting;
use super::person::Person;
use super::reach::ReachRecord;
use bytemuck::{Pod, Zeroable};

/// What perception remembers about preshaping.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PreshapeMemory {
    /// The present reach.
    pub reach: ReachRecord,
    /// The person's earlier reaches and hand.
    pub person: Person,
    /// The mixture that is being fitted to them.
    pub fitting: Fitting,
}
