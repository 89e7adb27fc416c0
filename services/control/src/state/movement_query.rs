use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::Blank;

/// How far the planning of the next movement has come.
///
/// A query is made from rest or in motion, and is answered with a trajectory or refused. A movement from rest begins as soon
/// as its trajectory is there. One from motion is planned from the state in which the arm will be in a certain cycle, and
/// begins in that very cycle.
///
/// ```text
/// None --> FromRest ------------> Planned { begins: now } --> None
/// None --> InMotion { begins } -> Planned { begins } -------> None
/// ```
///
/// A query that is refused ends as well; one in motion that is answered too late is made again, with more time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(C, u64)]
pub(crate) enum MovementQuery {
    /// Nothing is asked of the planner.
    None(Blank) = 0,
    /// A movement from rest is asked for.
    FromRest(Blank) = 1,
    /// A movement that begins in this cycle is asked for.
    InMotion { begins: u64 } = 2,
    /// The trajectory is there; it begins in this cycle.
    Planned { begins: u64 } = 3,
}

impl MovementQuery {
    pub const NONE: Self = Self::None(Blank::Zero);
    pub const FROM_REST: Self = Self::FromRest(Blank::Zero);

    /// Whether the planner has not answered yet.
    pub fn is_open(self) -> bool {
        matches!(self, Self::FromRest(_) | Self::InMotion { .. })
    }

    /// Whether a movement is bound to begin in a cycle to come.
    pub fn is_bound(self) -> bool {
        matches!(self, Self::InMotion { .. } | Self::Planned { .. })
    }
}
