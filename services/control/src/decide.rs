//! Which skill the robot uses.

use crate::Control;
use crate::inputs::Inputs;
use crate::pursue::LET_GO;
use crate::skill_choice::{self, SkillChoice};
use crate::state::{Skill, SkillPhase, StoredPose};
use coact_messages::{PERSON, ROBOT};
use coact_period::cycles;
use coact_stage_state::{Flag, Slot};
use nalgebra::Isometry3;
use std::time::Duration;

/// How long a skill goes on without a decision: between one decision and the next the network is silent for some 30 ms, in
/// which the arm would set off for its park posture.
const SILENCE: u64 = cycles(Duration::from_millis(120));
/// How long the hand stays ready for what is preshaped. Chosen by hand: longer than people pause between two actions.
const READY: u64 = cycles(Duration::from_secs(5));
/// How long touch must say that a part is in the hand, or was lost, of which nothing is known. Chosen by hand: longer than a
/// hand that moves shakes what it holds.
const CERTAIN: u64 = cycles(Duration::from_millis(100));
/// A part that is in the hand is seen this near to the grasp point, m: wherever fingers of this length can hold it.
const IN_HAND: f64 = 0.15;

impl Control {
    /// Begins another skill when the decision asks for one, as soon as the present phase allows it.
    pub(crate) fn decide(&mut self, inputs: &Inputs) {
        skill_choice::age(&mut self.state.decisions, &self.state.hand, inputs, &self.task.actions);
        self.notice_part(inputs);
        let serves = |decision: &_| skill_choice::decided_action(decision) == self.state.skill.action;
        if let Some(decision) = inputs.decision().filter(serves) {
            self.state.skill.since = decision.since;
        }
        let choice = self.unless_in_vain(SkillChoice::of(&self.state, inputs, &self.task.actions));
        let phase = self.state.skill.phase();
        let is_done = phase == SkillPhase::Idle && !self.state.skill.is_undecided();
        let is_silent = (1..SILENCE).contains(&self.state.decisions.silent);
        let goes_on = choice.is_under_way(&self.state.skill) || (choice.is_undecided() && is_silent);
        if phase.is_firm() || (goes_on && !is_done) || self.is_still_given(inputs) {
            return;
        }
        if choice.can_begin(inputs) {
            if !choice.is_undecided() {
                self.state.decisions.note_decision(inputs.tick());
            }
            self.begin_skill(&choice, inputs);
        } else if !self.state.skill.is_parking() || is_done {
            self.begin_skill(&choice.parked(), inputs);
        }
    }

    /// The same, but to park where the hand has been ready for long, and nothing has come of it: it may hide something. A myopic robot is never
    /// ready.
    fn unless_in_vain(&self, choice: SkillChoice) -> SkillChoice {
        let skill = &self.state.skill;
        let is_ready = skill.prepares.is_set() && skill.phase() == SkillPhase::Idle;
        let in_vain = is_ready && choice.is_under_way(skill) && skill.progress.age > READY;
        if in_vain || (self.myopic && choice.prepares) { choice.parked() } else { choice }
    }

    /// Whether the person, too, holds the part that the robot has received: an arm that set off would pull it out of her fingers. She has let go
    /// when no force of hers is felt any more, or when she is seen to.
    fn is_still_given(&self, inputs: &Inputs) -> bool {
        let received = self.state.hand.held().filter(|_| self.state.skill.skill == Skill::Receive);
        let is_felt = inputs.pull().is_none_or(|force| force > LET_GO);
        is_felt && received.is_some_and(|kind| inputs.in_person_hand(kind))
    }

    /// Notices a part in the hand of which nothing is known, as it is seen there, and one that was lost.
    fn notice_part(&mut self, inputs: &Inputs) {
        let (hand, skill) = (&mut self.state.hand, &mut self.state.skill);
        if skill.phase().is_firm() {
            return;
        }
        let found = inputs.in_robot_hand().filter(|_| hand.is_empty());
        let lost = !hand.is_empty() && inputs.touch() == Some(false);
        let touched = &mut skill.progress.touched;
        *touched = if lost || found.is_some() { touched.saturating_add(1) } else { 0 };
        if *touched <= CERTAIN {
            return;
        }
        *touched = 0;
        (hand.held, hand.from_table) = (Slot::EMPTY, Flag::Unset);
        let posture = self.servo.posture();
        let grasp_point = self.model.robot.grasp_point(&posture);
        let seen = found.and_then(|kind| Some((kind, inputs.sighting(kind, &grasp_point, IN_HAND)?.1)));
        if let Some((kind, frame)) = seen {
            let in_palm = self.model.robot.palm(&posture).inverse() * frame;
            (hand.held, hand.in_palm, hand.refused) = (Slot::of(kind), in_palm.into(), 0);
        }
    }

    /// Begins a skill, or parks when what it is about is not there. One that leads to where the hand goes already, or is, takes that up.
    fn begin_skill(&mut self, choice: &SkillChoice, inputs: &Inputs) {
        if self.state.skill.action != choice.action {
            self.state.decisions.misses = 0;
        }
        let skill = &mut self.state.skill;
        let goes_on = skill.leads_to(choice.skill, choice.kind);
        (skill.skill, skill.action, skill.kind) = (choice.skill, choice.action, choice.kind);
        skill.prepares = Flag::from(choice.prepares);
        self.state.planning.refusals = 0;
        if goes_on {
            skill.stops_before = Flag::Set;
            if skill.phase() == SkillPhase::Dwell {
                skill.enter(SkillPhase::Wait);
            }
            return;
        }
        let place = self.place(inputs);
        let skill = &mut self.state.skill;
        match place {
            Some(place) => skill.place = StoredPose::from(place),
            None => (skill.skill, skill.prepares) = (Skill::Park, Flag::Unset),
        }
        skill.stops_before = Flag::from(skill.skill == Skill::Receive);
        skill.enter(SkillPhase::Plan);
        self.ask(inputs);
    }

    /// Where the skill leads: the frame of a part or of a place; parking needs none.
    pub(crate) fn place(&self, inputs: &Inputs) -> Option<Isometry3<f64>> {
        let skill = &self.state.skill;
        let kind = skill.kind.get();
        match skill.skill {
            Skill::Park => None,
            Skill::Pick => inputs.part(ROBOT, kind?).map(|seen| self.goals.above_table(seen)),
            Skill::Insert | Skill::Steady => {
                Some(self.goals.socket(self.task.actions.get(skill.action.get()?)?.subgoal?))
            }
            Skill::PutBack => {
                let hand = &self.state.hand;
                let [x, y, _] = hand.picked_at;
                let is_known = hand.from_table.is_set();
                Some(self.goals.on_table(if is_known {
                    [x, y]
                } else {
                    self.goals.free_place(inputs.robot_parts())
                }))
            }
            Skill::Request | Skill::Receive | Skill::Give => Some(self.goals.handover_frame()),
            // The person is shown what lies at hand for the person.
            Skill::Point => inputs.part(PERSON, kind?).or_else(|| inputs.part(ROBOT, kind?)),
        }
    }
}
