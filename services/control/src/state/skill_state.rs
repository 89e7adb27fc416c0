use super::{PhaseProgress, Skill, SkillPhase, StoredPose};
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::{Flag, Implausible, Slot};

/// The skill under way, what it is about, and how far it has come.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct SkillState {
    pub skill: Skill,
    /// Action that it serves: index into `Task::actions`.
    pub action: Slot,
    /// [`Decision::since`](coact_messages::Decision) of the decision that it serves.
    pub since: u64,
    /// Kind of part that it is about.
    pub kind: Slot,
    /// Frame of what it is about: of a part, a socket, a place on the table, the handover place.
    pub place: StoredPose,
    /// Whether the hand stops before that place, to wait for the person.
    pub stops_before: Flag,
    /// Whether the action is not decided, but preshaped: the hand gets ready for it, and no more.
    pub prepares: Flag,
    phase: SkillPhase,
    pub progress: PhaseProgress,
}

impl SkillState {
    pub fn phase(&self) -> SkillPhase {
        self.phase
    }

    /// Enters a phase.
    pub fn enter(&mut self, phase: SkillPhase) {
        self.phase = phase;
        self.progress = PhaseProgress::zeroed();
    }

    /// The fingers have closed: what they have felt and seen meanwhile counts.
    pub fn verify(&mut self) {
        let PhaseProgress { touched, seen_in, .. } = self.progress;
        self.enter(SkillPhase::Verify);
        self.progress = PhaseProgress { touched, seen_in, ..self.progress };
    }

    /// Whether the hand goes, or is, where another skill begins: a part is requested where it is received.
    pub fn leads_to(&self, skill: Skill, kind: Slot) -> bool {
        let stands_or_comes = matches!(self.phase, SkillPhase::Plan | SkillPhase::Move | SkillPhase::Dwell);
        let requests = self.skill == Skill::Request && skill == Skill::Receive;
        requests && stands_or_comes && self.kind == kind
    }

    /// Whether nothing is asked of the arm and hand: the robot stands, or goes, to its park posture.
    pub fn is_parking(&self) -> bool {
        self.skill == Skill::Park
    }

    /// Whether no decision asks for what it does.
    pub fn is_undecided(&self) -> bool {
        self.is_parking() || self.prepares.is_set()
    }

    pub fn check(&self) -> Result<(), Implausible> {
        self.place.check("skill.place")?;
        self.progress.check()
    }
}
