use super::{ArmTrajectory, MovementQuery, QueryId};
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_period::cycles;
use coact_robot::Posture;
use coact_stage_state::{Implausible, ensure};
use std::time::Duration;

/// Control's dialogue with the planner.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct PlanningState {
    pub query: MovementQuery,
    /// The next trajectory, while the query is [`MovementQuery::Planned`].
    pub next: ArmTrajectory,
    /// The newest query.
    pub newest: QueryId,
    /// Cycles that the skill has waited for a trajectory since that query; counts up to the next one.
    pub waited: u64,
    /// Cycles ahead at which a movement begins that is asked for in motion.
    pub lead: u64,
    /// Movements in a row that the planner has refused.
    pub refusals: u64,
}

/// Cycles ahead at which a movement begins that is asked for in motion, at first: most are planned within that time, and a
/// decision waits no longer than that for the hand to turn.
const FIRST_LEAD: u64 = cycles(Duration::from_millis(40));
/// The same at most: each answer that is late doubles it. The arm then goes on to the old goal for so long.
const LONGEST_LEAD: u64 = cycles(Duration::from_millis(320));
/// Cycles after which a query that was refused is made again: the person, or a part, may have moved by then.
const PAUSE: u64 = cycles(Duration::from_millis(100));

impl PlanningState {
    /// Nothing was asked yet.
    pub fn at_rest(posture: Posture) -> Self {
        Self { next: ArmTrajectory::resting(posture), lead: FIRST_LEAD, ..Self::zeroed() }
    }

    /// Begins a new query, from rest or in motion, with this fingerprint.
    pub fn open(&mut self, query: MovementQuery, fingerprint: u64) {
        self.query = query;
        self.newest = QueryId { number: self.newest.number.wrapping_add(1), fingerprint };
        self.waited = 0;
    }

    /// Forgets a query that is not answered yet; the next one is made as soon as the skill waits for a trajectory.
    pub fn drop_query(&mut self) {
        if self.query.is_open() {
            self.query = MovementQuery::NONE;
        }
        self.waited = PAUSE;
    }

    /// Whether it is time for another query.
    pub fn is_due(&self) -> bool {
        self.waited > PAUSE && self.query == MovementQuery::NONE
    }

    /// The planner was late: it gets more time.
    pub fn lengthen_lead(&mut self) {
        self.lead = (2 * self.lead).min(LONGEST_LEAD);
    }

    pub fn check(&self) -> Result<(), Implausible> {
        self.next.check("planning.next")?;
        ensure((1..=LONGEST_LEAD).contains(&self.lead), "planning.lead", "a lead up to the longest one")
    }
}
