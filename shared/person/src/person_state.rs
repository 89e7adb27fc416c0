use crate::live_hand::LiveHand;
use crate::{Activity, ActivityPhase, HandMovement, HandPose, Hesitation, Intention, ReachTurn, Variation};
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_joint_task::Task;
use coact_messages::{ArmSide, PartnerError, PersonWait};
use coact_stage_state::{Flag, Implausible, Slot, ensure, finite};
use glam::DQuat;

/// Everything about the person that changes from tick to tick.
///
/// Ticks and cycles are those of the run.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub struct PersonState {
    phase: ActivityPhase,
    pub(crate) activity: Activity,
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
    /// Recorded way along which the present movement goes, unless it is a reach.
    pub(crate) way: Slot,
    /// How many actions of the script are done.
    pub(crate) script_done: u64,
    /// Tick at which the last action of the script ended.
    pub(crate) ended: u64,
    /// Tick of the present activity's reach onset.
    pub onset: u64,
    /// Tick of its grasp completion; 0: not yet.
    pub grasped: u64,
    /// What is wrong with the present activity, as things were at its onset; nothing once its turn has come before the
    /// grasp is complete.
    pub error: PartnerError,
    /// Which hand acts; the other one rests.
    pub side: ArmSide,
    /// Tick at which the person gives the present activity up, as soon as that is possible; 0: never.
    pub gives_up: u64,
    /// Tick at which the robot was first felt to pull, or to let go; 0: not yet.
    pub(crate) felt_since: u64,
    /// Where the hand is and how it is shaped.
    pub hand: HandPose,
    /// Its present movement.
    pub movement: HandMovement,
    /// How the present activity's reach has turned to another part, if it has.
    pub turn: ReachTurn,
    /// How the present activity's reach has stopped on its way, if it has.
    pub hesitation: Hesitation,
    /// Orientation of the carried part where it was taken.
    pub(crate) turn_from: [f64; 4],
    /// Orientation where it goes to.
    pub(crate) turn_to: [f64; 4],
    /// Where its centre was beside the middle of the finger tips when it was taken, m.
    pub(crate) offset: [f64; 3],
    /// Where the part is laid down if it is neither mounted nor given: where it lay before, or a free place, m.
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
    /// The hand as it is told from outside.
    pub(crate) live: LiveHand,
    /// The part between its open fingers.
    pub(crate) between: Slot,
    /// Whether nothing could be done, when the person last thought about it, before the robot has done something.
    pub(crate) awaits_robot: Flag,
}

impl PersonState {
    /// The present phase.
    pub fn phase(&self) -> ActivityPhase {
        self.phase
    }

    /// The present activity.
    pub fn activity(&self) -> Activity {
        self.activity
    }

    /// What the person can do nothing but wait for.
    pub fn waits_for(&self) -> PersonWait {
        match self.phase {
            ActivityPhase::AwaitSteadying => PersonWait::Steadying,
            ActivityPhase::Give => PersonWait::Receiving,
            ActivityPhase::Show => PersonWait::Part,
            ActivityPhase::AwaitRelease => PersonWait::Release,
            ActivityPhase::AwaitTurn => PersonWait::Subgoal,
            ActivityPhase::Rest if self.awaits_robot.is_set() => PersonWait::Subgoal,
            _ => PersonWait::Nothing,
        }
    }

    /// Goes over to another phase, which ends at tick `until` at the latest.
    pub fn enter(&mut self, phase: ActivityPhase, until: u64) {
        self.phase = phase;
        self.until = until;
        self.felt_since = 0;
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

    /// Refuses a state that nobody can be in who builds `task` with so many recorded reaches and ways, and has lived up
    /// to tick `now`.
    pub(crate) fn check(
        &self,
        task: &Task,
        (recordings, ways): (usize, usize),
        now: u64,
    ) -> Result<(), Implausible> {
        let indices = self.chain.is_below(task.chains.len())
            && self.subgoal.is_below(task.subgoals.len())
            && self.part.is_below(task.parts.len())
            && self.held.is_below(task.parts.len())
            && self.between.is_below(task.parts.len())
            && self.recording.is_below(recordings)
            && self.way.is_below(ways);
        ensure(indices, "person: chain, subgoal, part, recording or way", "one that there is")?;
        let since = [self.onset, self.grasped, self.felt_since, self.waiting_since, self.contact_since];
        ensure(since.iter().all(|tick| *tick <= now.max(1)), "person: tick", "one that has been")?;
        let counts =
            [self.ended >> 16, self.actions, self.skipped, self.script_done, self.variation.gives_up_after];
        ensure(counts.iter().all(|count| *count <= u64::from(u32::MAX)), "person: count", "32 bits at most")?;
        self.movement.check()?;
        self.turn.check(recordings, now)?;
        self.hesitation.check(now)?;
        self.live.check(now)?;
        self.check_numbers()
    }

    fn check_numbers(&self) -> Result<(), Implausible> {
        finite("person.hand", bytemuck::cast_slice(&[self.hand]))?;
        finite("person: place, force", &[self.offset, self.home, self.force].concat())?;
        finite("person.occluder", &self.occluder)?;
        finite("person.variation.blur", &[self.variation.blur])?;
        let carries = matches!(self.phase, ActivityPhase::Carry | ActivityPhase::Return);
        let turns = [self.turn_from, self.turn_to].map(DQuat::from_array);
        let are_turns = turns.iter().all(|turn| turn.is_finite() && (turn.is_normalized() || !carries));
        ensure(are_turns, "person: turn of the carried part", "unit quaternions")
    }
}
