use crate::hand::TrackedHand;
use crate::loss::Loss;
use crate::objects::PartTracks;
use crate::occlusion::Occlusion;
use crate::person_grips::PersonGrips;
use crate::plausible_cycle::cycle;
use crate::preshape::PreshapeState;
use crate::reaching::{HandPath, Likelihoods, PersonMovement};
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{ArmSide, Percept};
use coact_stage_state::{Flag, Implausible, StageState, StateError, ensure, finite};

/// Everything that perception must remember and that no other field of the percept holds: the words of
/// [`Percept::state`].
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct PerceptionState {
    /// The hand that acts, and its present movement.
    pub hand: TrackedHand,
    /// The other hand.
    pub other: TrackedHand,
    /// Whether it is the left one that acts.
    left_acts: Flag,
    /// The present reach's features, and what is known of this person's hand.
    pub preshape: PreshapeState,
    /// The acting hand's way since it lay still.
    pub path: HandPath,
    /// The other hand's.
    pub other_path: HandPath,
    /// How this person's hand moves.
    pub person: PersonMovement,
    /// How this person holds the hand in each grip.
    pub grips: PersonGrips,
    /// How well it fits a reach to each place.
    pub likelihoods: Likelihoods,
    /// Every part that has been sighted.
    pub parts: PartTracks,
    /// A hand that has gone out of sight.
    pub occlusion: Occlusion,
    /// A part that has gone out of the robot's hand.
    pub loss: Loss,
    /// Cycles that the hand has lain at rest, or that nothing has been seen of it for long.
    pub dwell: u64,
    /// Cycles that nothing has been seen of the hand.
    pub unseen: u64,
    /// Pitch of the hand when it took what it holds, or was first seen with it, rad; of the empty hand, its pitch now.
    grip_pitch: f64,
    /// Whether that pitch could be seen.
    grip_seen: Flag,
}

/// Why perception does not resume from a percept.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ResumeError {
    /// Its state is none.
    #[error(transparent)]
    State(#[from] StateError),
    /// A field beside the state is not what it can be.
    #[error("{0}; the message is damaged, start without it")]
    Field(Implausible),
}

impl StageState for PerceptionState {
    const STAGE: &'static str = "perception";
    const LAYOUT: u32 = 10;

    fn check(&self) -> Result<(), Implausible> {
        self.hand.check()?;
        self.other.check()?;
        self.preshape.check()?;
        self.path.check()?;
        self.other_path.check()?;
        self.person.check()?;
        self.grips.check()?;
        self.likelihoods.check()?;
        self.parts.check()?;
        self.occlusion.check()?;
        self.loss.check()?;
        cycle("dwell", self.dwell)?;
        cycle("unseen", self.unseen)?;
        finite("grip_pitch", &[self.grip_pitch])
    }
}

impl PerceptionState {
    /// The state that `last` holds, if that is a percept of a perception for so many `kinds` of part.
    pub fn of(last: &Percept, kinds: usize) -> Result<Self, ResumeError> {
        let state = Self::load(&last.state)?;
        let known = state.parts.are_about(kinds) && state.loss.is_about(kinds);
        ensure(known, "parts", "kinds of this task").map_err(ResumeError::Field)?;
        evidence(last).map_err(ResumeError::Field)?;
        Ok(state)
    }

    /// Which hand acts.
    pub fn acting(&self) -> ArmSide {
        if self.left_acts.is_set() { ArmSide::Left } else { ArmSide::Right }
    }

    /// From now on the other hand is the one that acts.
    pub fn change_hands(&mut self) {
        self.left_acts = Flag::from(!self.left_acts.is_set());
        std::mem::swap(&mut self.hand, &mut self.other);
        std::mem::swap(&mut self.path, &mut self.other_path);
        // Of the reach that was being recorded this hand knows nothing.
        self.preshape.reach = Zeroable::zeroed();
        self.dwell = 0;
    }

    /// Pitch of the hand when it took what it holds, or was first seen with it, rad; `None` if it could not be seen.
    pub fn grip_pitch(&self) -> Option<f64> {
        self.grip_seen.is_set().then_some(self.grip_pitch)
    }

    /// Keeps the pitch of an empty hand, or of one whose grip was not seen yet.
    pub fn keep_pitch(&mut self, pitch: Option<f64>) {
        self.grip_seen = pitch.is_some().into();
        self.grip_pitch = pitch.unwrap_or(0.0);
    }
}

/// Refuses evidence that is none.
fn evidence(last: &Percept) -> Result<(), Implausible> {
    let fractions = |field, values: &[f64]| {
        ensure(values.iter().all(|value| (0.0..=1.0).contains(value)), field, "evidence between 0 and 1")
    };
    fractions("act", &last.act)?;
    fractions("achieved", &last.achieved)?;
    fractions("open", &last.open)?;
    fractions("robot_holds", &last.robot_holds)?;
    fractions("person_holds", &last.person_holds)?;
    fractions("lost", &last.lost)?;
    last.workspace.iter().try_for_each(|workspace| {
        fractions("workspace.seen", &workspace.seen)?;
        fractions("workspace.gone", &workspace.gone)?;
        finite("workspace.position", workspace.position.as_flattened())?;
        finite("workspace.orientation", workspace.orientation.as_flattened())
    })
}
