//! The phases of each skill, one after the other.

use crate::Control;
use crate::inputs::Inputs;
use crate::robot::FingerShape;
use crate::state::{FinishedAction, MovementQuery, Skill, SkillPhase, StoredPose};
use coact_joint_task::ActionType;
use coact_period::cycles;
use coact_stage_state::{Flag, Slot};
use nalgebra::Isometry3;
use std::time::Duration;

/// How long the person's hand must wait at the handover place before the robot takes the part. Chosen by hand: a hand that
/// only passes is not taken for one that waits.
const MET: u64 = cycles(Duration::from_millis(100));
/// Force of the person at which the robot lets a part go, N. Chosen by hand: more than a touch, less than what pulls a part
/// out of closed fingers.
const PULL: f64 = 1.5;
/// How long it must last: the wrist's sensor reports means of 30 ms, so that one of them is past.
const PULLED: u64 = cycles(Duration::from_millis(30));
/// The same of a part that the robot has for itself: a hand that only brushes it, or a part that only touches its place, takes nothing.
/// Chosen by hand.
const INSISTED: u64 = cycles(Duration::from_millis(500));
/// Force below which the person has let go, N. Chosen by hand: above what the held part's own acceleration makes of it.
pub(crate) const LET_GO: f64 = 0.3;
/// After so long, a handover that does not come about is given up. Chosen by hand: people who assemble are busy for longer than
/// 10 s at times, and another action may be possible by then.
const PATIENCE: u64 = cycles(Duration::from_secs(30));
/// The same of a request, which is made again then. Chosen by hand: the hand that is held out hides from the robot's eye what is behind it, and
/// what the robot believes to be mounted there may be so no more.
const REQUESTS: u64 = cycles(Duration::from_secs(10));
/// A part that has moved farther than this while the hand reaches for it is followed, m. Chosen by hand: above the scatter of
/// its estimate, below what the open fingers leave room for.
const MOVED: f64 = 0.008;

impl Control {
    /// Carries the skill's present phase on, and enters the next one when it has ended.
    pub(crate) fn pursue(&mut self, inputs: &Inputs) {
        let age = &mut self.state.skill.progress.age;
        *age = age.saturating_add(1);
        self.feel_pull(inputs);
        self.take_up_movement(inputs);
        match self.state.skill.phase() {
            SkillPhase::Idle => {}
            SkillPhase::Plan | SkillPhase::Move if self.servo.arm_stands() && self.is_taken(inputs) => {
                // The person comes to meet a hand that does not get on: no movement begins any more but out of her hand.
                // Whatever it was for, it is given now.
                self.state.skill.skill = Skill::Give;
                self.state.planning.query = MovementQuery::NONE;
                self.state.arm.rest_in_hand(self.servo.posture());
                self.move_fingers(SkillPhase::Open);
            }
            // She insists on what goes elsewhere: the arm stops first.
            SkillPhase::Move if self.state.skill.skill != Skill::Give && self.is_taken(inputs) => {
                self.state.arm.braking = Flag::Set;
            }
            SkillPhase::Plan => self.ask_again(inputs),
            SkillPhase::Move => self.go_on(inputs),
            SkillPhase::Wait => self.wait_for_person(inputs),
            SkillPhase::Dwell => self.dwell(inputs),
            SkillPhase::Verify => self.verify(inputs),
            SkillPhase::Close if self.state.fingers.has_arrived() => self.state.skill.verify(),
            // She takes what she had let go of, before they have closed on it again.
            SkillPhase::Close if self.is_taken(inputs) => self.move_fingers(SkillPhase::Open),
            SkillPhase::Close => self.feel_and_look(inputs),
            SkillPhase::Open => self.open(inputs),
        }
    }

    /// On the way: the fingers follow once the hand has left; a part that moves is followed, and a path around a person in the
    /// way is looked for.
    fn go_on(&mut self, inputs: &Inputs) {
        self.shape_fingers();
        if self.state.planning.query != MovementQuery::NONE {
            return;
        }
        if self.state.arm.braking.is_set() {
            self.state.skill.enter(SkillPhase::Plan);
        } else if self.state.arm_has_arrived() && self.state.fingers.has_arrived() {
            self.arrive(inputs);
        } else if let Some(place) = self.moved_target(inputs).filter(|_| self.can_ask()) {
            self.state.skill.place = StoredPose::from(place);
            self.ask(inputs);
        } else if self.state.arm.blocked > cycles(self.limits.guard.blocked) {
            (self.state.arm.blocked, self.state.arm.braking) = (0, Flag::Set);
        }
    }

    /// The fingers take the shape that the skill needs, from when the hand has left the place where it was, or where there is
    /// room for that.
    fn shape_fingers(&mut self) {
        let skill = &self.state.skill;
        let shape = self.model.on_the_way(skill.skill, skill.kind.get(), self.held_in());
        let wanted = self.model.finger_angles(shape);
        let arm = &self.state.arm;
        let may_move =
            !self.state.planning.query.is_bound() && arm.progress.elapsed >= arm.trajectory.fingers_begin;
        if may_move && self.state.fingers.target != wanted {
            self.servo.launch_fingers(&mut self.state.fingers, wanted);
        }
    }

    /// Where the part lies that is reached for, if that is elsewhere than it was and the hand does not approach it yet.
    fn moved_target(&self, inputs: &Inputs) -> Option<Isometry3<f64>> {
        let (arm, skill) = (&self.state.arm, &self.state.skill);
        if skill.skill != Skill::Pick || arm.progress.elapsed >= arm.trajectory.approach_begins {
            return None;
        }
        let place = self.place(inputs)?;
        let way = (place.translation.vector - skill.place.isometry().translation.vector).norm();
        (way > MOVED).then_some(place)
    }

    fn arrive(&mut self, inputs: &Inputs) {
        let skill = &mut self.state.skill;
        match skill.skill {
            _ if self.state.arm.trajectory.withdraws.is_set() => {
                skill.enter(SkillPhase::Plan);
                self.ask(inputs);
            }
            _ if skill.is_undecided() => skill.enter(SkillPhase::Idle),
            Skill::Park => skill.enter(SkillPhase::Idle),
            Skill::Receive if skill.stops_before.is_set() => skill.enter(SkillPhase::Wait),
            Skill::Pick | Skill::Receive => self.move_fingers(SkillPhase::Close),
            Skill::Insert | Skill::PutBack if self.state.hand.is_empty() => skill.enter(SkillPhase::Idle),
            Skill::Insert | Skill::PutBack => self.move_fingers(SkillPhase::Open),
            Skill::Request | Skill::Give | Skill::Steady | Skill::Point => skill.enter(SkillPhase::Dwell),
        }
    }

    /// Waits before the handover place until the person's hand waits there with the part.
    fn wait_for_person(&mut self, inputs: &Inputs) {
        let skill = &mut self.state.skill;
        let is_given = skill.kind.get().is_some_and(|kind| inputs.in_person_hand(kind))
            && inputs.person_waits_at(&self.goals.handover());
        let is_pressed = inputs.pull().is_some_and(|force| force > LET_GO);
        let met = &mut skill.progress.met;
        *met = if is_given { met.saturating_add(1) } else { 0 };
        if *met >= MET || (is_given && is_pressed) {
            skill.stops_before = Flag::Unset;
            skill.enter(SkillPhase::Plan);
            self.ask(inputs);
        } else if skill.progress.age > PATIENCE {
            self.give_up();
        }
    }

    /// Stands at the goal; a part that is given is let go when the person pulls at it, and nothing is given or requested for ever.
    fn dwell(&mut self, inputs: &Inputs) {
        let most = match self.state.skill.skill {
            Skill::Give => PATIENCE,
            Skill::Request => REQUESTS,
            _ => u64::MAX,
        };
        if self.is_taken(inputs) {
            self.move_fingers(SkillPhase::Open);
        } else if self.state.skill.progress.age > most {
            self.give_up();
        }
    }

    /// For how long the person has pulled at the held part, with a hand that can have it.
    fn feel_pull(&mut self, inputs: &Inputs) {
        let can_take = self.state.hand.held().is_some_and(|kind| inputs.person_can_take(kind));
        let pulls = can_take && inputs.pull().is_some_and(|force| force > PULL);
        let pulled = &mut self.state.hand.pulled;
        *pulled = if pulls { pulled.saturating_add(1) } else { 0 };
    }

    /// Whether the person has pulled for a while at the part that the robot gives, or insists on another one: her hand is there as well.
    fn is_taken(&self, inputs: &Inputs) -> bool {
        let pulled = self.state.hand.pulled;
        match self.state.skill.skill {
            Skill::Give => pulled >= PULLED,
            Skill::Insert | Skill::PutBack => {
                let here = || self.model.robot.grasp_point(&self.servo.posture());
                pulled >= INSISTED && inputs.person_waits_at(&here())
            }
            _ => false,
        }
    }

    /// Opens the fingers; they close again on a part that the person has let go before they did.
    fn open(&mut self, inputs: &Inputs) {
        let gives = self.state.skill.skill == Skill::Give && !self.state.hand.is_empty();
        let alone = inputs.pull().is_some_and(|force| force < LET_GO) && inputs.touch() == Some(true);
        if gives && alone {
            self.move_fingers(SkillPhase::Close);
        } else if self.state.fingers.has_arrived() {
            self.let_go();
        }
    }

    /// The fingers have opened: what they held is where it belongs, or the person has it. Where that was not decided, the action has failed.
    fn let_go(&mut self) {
        if !self.state.hand.is_empty() {
            let action = self.state.skill.action.get().and_then(|index| self.task.actions.get(index));
            let is_decided = action.is_some_and(|action| action.action_type == ActionType::Give);
            self.state.hand.held = Slot::EMPTY;
            self.finish(Flag::from(self.state.skill.skill == Skill::Give && !is_decided));
        }
        self.state.skill.enter(SkillPhase::Idle);
    }

    /// The action is given up: the same decision does not start it again for a while.
    pub(crate) fn give_up(&mut self) {
        self.finish(Flag::Set);
        self.state.skill.enter(SkillPhase::Idle);
    }

    /// The action is done, or has failed: the same decision does not start it again.
    pub(crate) fn finish(&mut self, failed: Flag) {
        let skill = &self.state.skill;
        self.state.decisions.finished =
            FinishedAction { action: skill.action, since: skill.since, age: 0, failed };
    }

    /// Closes or opens the fingers where the hand is.
    pub(crate) fn move_fingers(&mut self, phase: SkillPhase) {
        let kind = self.state.skill.kind.get();
        let grip = kind.map(|kind| self.model.grips.known(self.state.hand.grip.get(), kind));
        let shape = if phase == SkillPhase::Close { FingerShape::Closed } else { FingerShape::Open };
        let angles = self.model.finger_angles(grip.map_or(FingerShape::Relaxed, shape));
        self.servo.launch_fingers(&mut self.state.fingers, angles);
        self.state.skill.enter(phase);
    }
}
