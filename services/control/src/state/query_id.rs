use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// Which query it is, for a stage and its standby alike: both ask planners of their own, and either may go on from the other's
/// state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(C)]
pub(crate) struct QueryId {
    /// From 1; 0 before the first.
    pub number: u64,
    /// Of what is asked: two instances that went apart number different queries alike.
    pub fingerprint: u64,
}
