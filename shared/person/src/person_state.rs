use crate::{Activity, ActivityPhase, HandMovement, HandPose, Intention, Slot, Variation};
use bytemuck::{Pod, Zeroable};

/// Everything about the person that changes from tick to tick.
///
/// Ticks and cycles are those of the run.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct PersonState {
    /// [`ActivityPhase`].
    phase: u64,
    /// [`Activity`].
    activity: u64,
    /// Tick at which the present phase ends by itself, or patience with it.
    pub until: u64,
    /// Activities begun so far.
    pub actions: u64,
    /// Chain of the present activity.
    pub chain: Slot,
    /// Subgoal that it serves.
    pub subgoal: Slot,
    /// Part that it is about.
    pub part: Slot,
    /// Part between the person's fingers.
    pub held: Slot,
    /// Recorded reach that drives the hand.
    pub(crate) recording: Slot,
    /// How many actions of the script are done.
    pub(crate) script_done: u64,
    /// Tick at which the last action of the script ended.
    pub(crate) ended: u64,
    /// Tick of the present activity's reach onset.
    pub onset: u64,
    /// Tick of its grasp completion; 0: not yet.
    pub grasped: u64,
    /// [`coact_messages::PartnerError`] of the present activity, as things were at its onset; none once its turn has come
    /// before the grasp is complete.
    pub error: u64,
    /// Tick at which the person gives the present activity up, as soon as that is possible; 0: never.
    pub gives_up: u64,
    /// Tick at which the robot was first felt to pull, or to let go; 0: not yet.
    pub(crate) felt_since: u64,
    /// Where the hand is and how it is shaped.
    pub hand: HandPose,
    /// Its present movement.
    pub movement: HandMovement,
    /// Orientation of the carried part where it was taken.
    pub(crate) turn_from: [f64; 4],
    /// Orientation where it goes to.
    pub(crate) turn_to: [f64; 4],
    /// Where its centre was beside the middle of the finger tips when it was taken, m.
    pub(crate) offset: [f64; 3],
    /// Where the part lay before, m.
    pub(crate) home: [f64; 3],
    /// How the present activity differs from the plain one.
    pub variation: Variation,
    /// The box that stands before the part of the present activity, if it is hidden: centre and half extents, m; else zeros.
    occluder: [f64; 6],
    /// What is to be said now: action of the script, or phrase of the present chain.
    pub(crate) to_say: Slot,
    /// Tick since which the script's next action has been waiting for a part; 0: it is not.
    pub(crate) waiting_since: u64,
    /// Actions of the script that were left out because no part came.
    pub skipped: u64,
    /// Tick since which the person has pulled at a part in the robot's hand, or pressed one into it; 0: does not.
    pub(crate) contact_since: u64,
    /// Force of the person's hand on the robot's, through the part that both have, N, world frame.
    pub force: [f64; 3],
}

impl PersonState {
    /// The present phase; words that are none mean rest.
    pub fn phase(&self) -> ActivityPhase {
        ActivityPhase::ALL.get(self.phase as usize).copied().unwrap_or(ActivityPhase::Rest)
    }

    /// The present activity.
    pub fn activity(&self) -> Activity {
        Activity::ALL.get(self.activity as usize).copied().unwrap_or(Activity::Insert)
    }

    /// Goes over to another phase, which ends at tick `until` at the latest.
    pub fn enter(&mut self, phase: ActivityPhase, until: u64) {
        self.phase = phase as u64;
        self.until = until;
        self.felt_since = 0;
    }

    pub(crate) fn set_activity(&mut self, activity: Activity) {
        self.activity = activity as u64;
    }

    /// What the person means by the present activity.
    pub(crate) fn intention(&self) -> Option<Intention> {
        let (activity, subgoal, part) = (self.activity(), self.subgoal.get(), self.part.get());
        let variation = self.variation;
        self.chain.get().map(|chain| Intention { activity, chain, subgoal, part, variation })
    }

    /// The box that stands before the part of the present activity, until the hand is back at rest: centre and half
    /// extents, m.
    pub fn occluder(&self) -> Option<[f64; 6]> {
        (self.occluder != [0.0; 6]).then_some(self.occluder)
    }

    pub(crate) fn set_occluder(&mut self, occluder: Option<[f64; 6]>) {
        self.occluder = occluder.unwrap_or_default();
    }
}
