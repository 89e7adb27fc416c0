use super::{
    ArmState, DecisionState, FINGER_JOINTS, FingerState, HandState, MovementQuery, PlanningState, Skill,
    SkillPhase, SkillState,
};
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_robot::Posture;
use coact_seen_parts::SeenParts;
use coact_stage_state::{Flag, Implausible, StageState};

/// All that control keeps from cycle to cycle, besides the setpoints.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct ControlState {
    pub arm: ArmState,
    pub fingers: FingerState,
    pub skill: SkillState,
    pub hand: HandState,
    pub planning: PlanningState,
    pub decisions: DecisionState,
    pub seen: SeenParts,
}

impl StageState for ControlState {
    const STAGE: &'static str = "control";
    const LAYOUT: u32 = 9;

    fn check(&self) -> Result<(), Implausible> {
        let Self { arm, fingers, skill, hand, planning, decisions: _, seen } = self;
        arm.check()?;
        fingers.check()?;
        skill.check()?;
        hand.check()?;
        planning.check()?;
        seen.check()
    }
}

impl ControlState {
    /// At rest at `position`, knowing nothing.
    pub fn at_rest(position: [f64; JOINTS]) -> Self {
        let (arm, fingers) = split(position);
        Self {
            arm: ArmState::at_rest(arm),
            fingers: FingerState::at_rest(fingers),
            planning: PlanningState::at_rest(arm),
            ..Self::zeroed()
        }
    }

    /// Whether the arm is at its goal, and no further movement is bound to begin.
    pub fn arm_has_arrived(&self) -> bool {
        self.arm.is_at_end() && !self.planning.query.is_bound()
    }

    /// Whether a handover is declared for `t` s after the start of the trajectory, in which the robot's hand may touch the
    /// person's: where it receives what the person gives, where its fingers take their shape for that, where it brings a part to the
    /// person's hand and lets it go, while it stands there and the next movement is planned, and while it leaves that hand. On the way
    /// there it keeps clear of it.
    pub fn may_touch_person(&self, t: f64) -> bool {
        let stays = matches!(self.skill.phase(), SkillPhase::Idle | SkillPhase::Plan) && self.arm.is_at_end();
        let leaves = stays || self.arm.trajectory.is_leaving(t);
        (self.hand.hands_over.is_set() && leaves)
            || match self.skill.skill {
                _ if self.skill.prepares.is_set() => false,
                Skill::Receive => !self.skill.stops_before.is_set() || self.waits_for_fingers(),
                Skill::Give => self.arm.trajectory.is_approach(t) || self.skill.phase() == SkillPhase::Open,
                _ => false,
            }
    }

    /// Whether the arm's motion is part of a handover, as its command declares: where it may touch the person's hand, and while an arm that
    /// breaks a handover off brakes, for no arm stands at once.
    pub fn moves_in_handover(&self) -> bool {
        let breaks_off = self.hand.hands_over.is_set() && self.skill.phase() == SkillPhase::Plan;
        self.may_touch_person(self.arm.progress.elapsed) || (breaks_off && self.arm.brakes())
    }

    /// Whether the arm is at its goal, and the fingers still move.
    pub fn waits_for_fingers(&self) -> bool {
        self.skill.phase() == SkillPhase::Move && self.arm_has_arrived() && !self.fingers.has_arrived()
    }

    /// A handover lasts from when the hand is at the person's until the next movement has left it.
    pub fn note_handover(&mut self) {
        let now = self.arm.progress.elapsed;
        if matches!(self.skill.skill, Skill::Receive | Skill::Give) && self.may_touch_person(now) {
            self.hand.hands_over = Flag::Set;
        } else if self.skill.phase() == SkillPhase::Move && !self.arm.trajectory.is_leaving(now) {
            self.hand.hands_over = Flag::Unset;
        }
    }

    /// The arm stands where it has braked; what was asked for in motion begins from there.
    pub fn rest_arm(&mut self, posture: Posture, tick: u64) {
        self.arm.rest(posture);
        self.planning.query = match self.planning.query {
            MovementQuery::InMotion { .. } => MovementQuery::FROM_REST,
            MovementQuery::Planned { .. } => MovementQuery::Planned { begins: tick },
            query => query,
        };
    }

    /// Whether every index names one of so many actions, kinds of parts and grips.
    pub fn is_of_task(&self, actions: usize, kinds: usize, grips: usize) -> bool {
        let Self { skill, hand, decisions, .. } = self;
        skill.action.is_below(actions)
            && decisions.finished.action.is_below(actions)
            && [skill.kind, hand.held].iter().all(|kind| kind.is_below(kinds))
            && hand.grip.is_below(grips)
    }
}

/// Arm and fingers of a row of all joints.
pub(crate) fn split(position: [f64; JOINTS]) -> (Posture, [f64; FINGER_JOINTS]) {
    (std::array::from_fn(|joint| position[joint]), std::array::from_fn(|joint| position[ARM_JOINTS + joint]))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::state::ArmTrajectory;
    use coact_motion::Plan;
    use coact_robot::{Knot, MotionState};

    #[test]
    fn a_handover_lasts_while_the_hand_stands_in_the_persons_and_until_it_has_left() {
        let mut state = ControlState::at_rest([0.1; JOINTS]);
        state.skill.skill = Skill::Give;
        state.arm.rest_in_hand([0.1; ARM_JOINTS]);
        assert_eq!(state.arm.enclosed(), 1.0, "the next movement leads out");
        let mut declared = |skill, phase| {
            state.skill.skill = skill;
            state.skill.enter(phase);
            state.note_handover();
            state.may_touch_person(0.0)
        };
        assert!(!declared(Skill::Give, SkillPhase::Plan), "not there yet");
        assert!(declared(Skill::Give, SkillPhase::Open));
        assert!(declared(Skill::Give, SkillPhase::Idle) && declared(Skill::Steady, SkillPhase::Plan));
        // A movement that leaves nothing ends it.
        assert!(!declared(Skill::Steady, SkillPhase::Move) && !declared(Skill::Steady, SkillPhase::Plan));
    }

    #[test]
    fn an_arm_that_breaks_a_handover_off_declares_it_while_it_brakes() {
        let knot = |t| Knot { t, states: [MotionState::at_rest(t); ARM_JOINTS] };
        let plan = Plan { knots: vec![knot(0.0), knot(1.0)], ..Plan::default() };
        let mut state = ControlState::at_rest([0.0; JOINTS]);
        state.arm.follow(&ArmTrajectory::of(&plan).unwrap());
        state.arm.progress.elapsed = 0.5;
        state.skill.skill = Skill::Receive;
        state.skill.enter(SkillPhase::Move);
        state.note_handover();
        assert!(state.moves_in_handover(), "it closes on the person's hand");
        state.skill.skill = Skill::Steady;
        state.skill.enter(SkillPhase::Plan);
        assert!(!state.moves_in_handover(), "an arm that goes on keeps clear");
        state.arm.progress.override_rate = -1.0;
        assert!(
            state.moves_in_handover() && !state.may_touch_person(0.5),
            "what is left of it belongs to it"
        );
    }
}
