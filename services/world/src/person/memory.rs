use super::{HandPose, Intention, Manner, Movement};
use crate::slot::Slot;
use bytemuck::{Pod, Zeroable};
use coact_messages::PartnerPhase;

/// Everything that the person remembers.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct PersonMemory {
    /// [`Stage`].
    stage: u64,
    /// [`Errand`].
    errand: u64,
    /// Tick at which the present stage ends by itself (or is given up).
    pub until: u64,
    /// Actions begun so far.
    pub actions: u64,
    pub chain: Slot,
    pub subgoal: Slot,
    /// Part that the present action is about.
    pub part: Slot,
    /// Part between the person's fingers.
    pub grip: Slot,
    /// Recorded reach that drives the hand.
    pub recording: Slot,
    /// Actions of the script that are done.
    pub script: u64,
    /// Tick at which the last action of the script ended.
    pub ended: u64,
    pub onset: u64,
    pub grasped: u64,
    /// [`coact_messages::PartnerError`] of the present action, as things were at its onset; none once its turn has come
    /// before the grasp is complete.
    pub error: u64,
    /// Tick at which the person gives the present action up, as soon as that is possible; 0: never.
    pub gives_up: u64,
    /// Tick at which the robot was first felt to pull, or to let go; 0: not yet.
    pub felt: u64,
    pub hand: HandPose,
    pub movement: Movement,
    /// Held part: orientation where it was taken and where it goes to, and where its centre was beside the
    /// middle of the finger tips, m.
    pub turn_from: [f64; 4],
    pub turn_to: [f64; 4],
    pub offset: [f64; 3],
    /// Where the part lay before, m.
    pub home: [f64; 3],
    /// How the present action is carried out.
    pub manner: Manner,
    /// What stands before the part of the present action, if it is hidden: centre and half extents, m; else zeros.
    screen: [f64; 6],
    /// What is to be said now: action of the script, or phrase of the present chain.
    pub says: Slot,
    /// Tick since which the script's next action has been waiting for a part; 0: not.
    pub waiting: u64,
    /// Actions of the script that were given up because no part came.
    pub skipped: u64,
    /// Tick since which the person has pulled at a part in the robot's hand, or pressed one into it; 0: does not.
    pub contact: u64,
    /// Force of the person's hand on the robot's, through the part that both have, N, world frame.
    pub force: [f64; 3],
}

/// What an action is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub(crate) enum Errand {
    /// Take a part of one's own workspace and mount it.
    Mount = 0,
    /// Take it and hand it over.
    HandOver = 1,
    /// Show a gesture that asks for a part.
    Request = 2,
    /// Take the part that the robot offers and mount it.
    Take = 3,
}

/// Step of an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub(crate) enum Stage {
    Rest = 0,
    /// Under way, but not yet so fast that an observer would speak of a reach.
    Prepare = 1,
    Reach = 2,
    /// Fingers closed, part not yet lifted.
    Dwell = 3,
    Carry = 4,
    /// At the socket, until the robot steadies the base.
    AwaitHold = 5,
    Mount = 6,
    /// The part is held out to the robot.
    Offer = 7,
    /// Nobody took it: back to where it lay.
    Return = 8,
    /// The gesture is shown.
    Show = 9,
    /// Fingers on a part that the robot has not let go yet.
    AwaitRelease = 10,
    Withdraw = 11,
}

const STAGES: [Stage; 12] = [
    Stage::Rest,
    Stage::Prepare,
    Stage::Reach,
    Stage::Dwell,
    Stage::Carry,
    Stage::AwaitHold,
    Stage::Mount,
    Stage::Offer,
    Stage::Return,
    Stage::Show,
    Stage::AwaitRelease,
    Stage::Withdraw,
];

const ERRANDS: [Errand; 4] = [Errand::Mount, Errand::HandOver, Errand::Request, Errand::Take];

impl PersonMemory {
    /// The present stage; words that are none mean rest.
    pub fn stage(&self) -> Stage {
        STAGES.get(self.stage as usize).copied().unwrap_or(Stage::Rest)
    }

    pub fn errand(&self) -> Errand {
        ERRANDS.get(self.errand as usize).copied().unwrap_or(Errand::Mount)
    }

    pub fn enter(&mut self, stage: Stage, until: u64) {
        self.stage = stage as u64;
        self.until = until;
        self.felt = 0;
    }

    pub fn set_errand(&mut self, errand: Errand) {
        self.errand = errand as u64;
    }

    /// What the person means by the present action.
    pub fn intention(&self) -> Option<Intention> {
        let (errand, subgoal, part) = (self.errand(), self.subgoal.get(), self.part.get());
        self.chain.get().map(|chain| Intention { errand, chain, subgoal, part, manner: self.manner })
    }

    /// The box that stands before the part of the present action, until the hand is back at rest: centre and half
    /// extents, m.
    pub fn screen(&self) -> Option<[f64; 6]> {
        (self.screen != [0.0; 6]).then_some(self.screen)
    }

    pub fn set_screen(&mut self, screen: Option<[f64; 6]>) {
        self.screen = screen.unwrap_or_default();
    }

    /// Whether the person can do nothing but wait for the robot.
    pub fn waits(&self) -> bool {
        matches!(self.stage(), Stage::AwaitHold | Stage::Offer | Stage::Show | Stage::AwaitRelease)
    }

    /// What the monitor is told.
    pub fn phase(&self) -> PartnerPhase {
        match self.stage() {
            Stage::Rest | Stage::Prepare => PartnerPhase::Idle,
            Stage::Reach => PartnerPhase::Reach,
            Stage::Dwell | Stage::Carry | Stage::Return => PartnerPhase::Transport,
            Stage::AwaitHold | Stage::Mount | Stage::Offer | Stage::Show | Stage::AwaitRelease => {
                PartnerPhase::Act
            }
            Stage::Withdraw => PartnerPhase::Withdraw,
        }
    }
}
