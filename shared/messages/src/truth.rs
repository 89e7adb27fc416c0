use crate::plausible::{index, not_after, optional, subgoal};
use crate::{ArmSide, Flaw, Header, JOINTS, MAX_POPULATIONS, PersonWait, Plausible, WORKSPACES};
use bytemuck::{CheckedBitPattern, NoUninit, Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// What really happens, for who measures, records and shows: nobody who decides may subscribe to this topic (1 kHz).
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::Truth")]
pub struct Truth {
    /// Header.
    pub header: Header,
    /// The person's actions begun so far (an action starts at reach onset; idling is none).
    pub actions: u32,
    /// [`PartnerPhase`] of the person now.
    pub phase: u32,
    /// Chain that the person is carrying out: index into `Task::chains`, or [`NONE`](crate::NONE).
    pub chain: u32,
    /// Subgoal that the person means to bring about: index into `Task::subgoals`, or [`NONE`](crate::NONE).
    pub subgoal: u32,
    /// Cycle of the present (or last) action's reach onset.
    pub onset_cycle: u64,
    /// Cycle at which the fingers closed on the part (a gesture: at which it was fully shown); 0 until then.
    pub grasp_cycle: u64,
    /// Cycle at which the action's reach turned from the part for which the hand had set out to another one: the second movement began
    /// then. From there on `chain`, `subgoal` and `error` are those of the new part. 0: it has not turned.
    pub turn_cycle: u64,
    /// First cycle after that from which on, for 50 ms at least, the hand moved more in the direction of the new part than in that of the
    /// old one; 0 until then, and again where it has not lasted so long.
    pub heading_cycle: u64,
    /// Cycle at which the hand began to stop on its way, to go on to the same part later; 0: the action's reach has not hesitated.
    pub hesitation_cycle: u64,
    /// Bit i set: subgoal i's part is really in its place.
    pub achieved: u64,
    /// Completed assemblies before the present one (the scene is laid out again after each).
    pub assemblies: u64,
    /// [`PartnerError`] of the present action, as things were at its onset; none once its turn has come before the
    /// grasp is complete.
    pub error: u32,
    /// [`PersonWait`]: what the person can do nothing but wait for.
    pub waiting: u32,
    /// 1 while the person's action leads behind something that hides the part, and the hand at it, from the robot. Else 0.
    pub hidden: u32,
    /// 1 while the command that the joints follow declares a handover, in which the robot's hand may touch the person's. Else 0.
    pub handover: u32,
    /// The hand with which the person acts, or acted last: [`ArmSide`](crate::ArmSide) as a number.
    pub side: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// Where the joints are, rad.
    pub joints: [f64; JOINTS],
    /// Where shoulder, elbow, wrist and middle finger tip of the person's arms are, m, by [`ArmSide`](crate::ArmSide); zeros: there is none.
    pub arms: [[[f64; 3]; 4]; 2],
    /// Bit i set: part i of `Task::parts` is in the hand of [`ROBOT`](crate::ROBOT), of [`PERSON`](crate::PERSON).
    pub held: [u64; WORKSPACES],
}

/// What is wrong with one of the person's actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, CheckedBitPattern, NoUninit, Zeroable)]
#[repr(u32)]
pub enum PartnerError {
    /// Nothing.
    None = 0,
    /// Intention: the subgoal's turn has not come.
    Early = 1,
    /// Intention: the subgoal is achieved already.
    Done = 2,
    /// Means: a part is asked for that lies in the person's own workspace.
    AtHand = 3,
}

/// What the person is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum PartnerPhase {
    /// Hand at rest.
    Idle = 0,
    /// From onset until the fingers have closed (or the gesture is fully shown).
    Reach = 1,
    /// Carrying the part to its place or to the robot.
    Transport = 2,
    /// At the place: mounting it, holding it out, or keeping the gesture up.
    Act = 3,
    /// Moving the empty hand back to rest.
    Withdraw = 4,
}

impl Truth {
    /// What the person can do nothing but wait for.
    pub fn person_wait(&self) -> PersonWait {
        PersonWait::ALL.get(self.waiting as usize).copied().unwrap_or(PersonWait::Nothing)
    }
}

impl Plausible for Truth {
    fn check(&self) -> Result<(), Flaw> {
        index("phase", self.phase, PartnerPhase::Withdraw as usize + 1)?;
        optional("chain", self.chain, MAX_POPULATIONS)?;
        subgoal("subgoal", self.subgoal)?;
        not_after(
            "cycles",
            &self.header,
            &[self.onset_cycle, self.grasp_cycle, self.turn_cycle, self.heading_cycle, self.hesitation_cycle],
        )?;
        index("error", self.error, PartnerError::AtHand as usize + 1)?;
        index("waiting", self.waiting, PersonWait::ALL.len())?;
        index("hidden", self.hidden, 2)?;
        index("handover", self.handover, 2)?;
        index("side", self.side, ArmSide::BOTH.len())
    }
}
