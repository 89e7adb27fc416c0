//! Between planner and servo: queries, and the trajectories that answer them.

use crate::Control;
use crate::inputs::Inputs;
use crate::planning::{INSERTION_DEPTH, PlanningQuery, Surroundings};
use crate::state::{MovementQuery, Skill, SkillPhase};
use coact_joint_task::ActionType;
use coact_period::seconds;
use coact_robot::{MotionState, NextUse};
use coact_stage_state::{Flag, Slot};
use nalgebra::{Isometry3, Vector3};

/// Refusals after which a part is put down as it comes. Chosen by hand: 1 s, for each takes a pause of 100 ms.
const LOOSELY: u64 = 10;
/// Refusals after which an action is given up for a while. Chosen by hand: 3 s, in which whoever is in the way may leave.
const MOST_REFUSALS: u64 = 30;
/// How far a hand lifts a part that it has picked, m. Chosen by hand: out from between the parts beside it.
const LIFT: f64 = 0.06;
/// How far a hand goes back out of where it is otherwise, m. Chosen by hand: the fingers are clear of what they have let go.
const RETREAT: f64 = 0.07;
/// A hand less far in a narrow place than this fraction of the way is out of it: 5 mm of a retreat.
const OUT: f64 = 0.05;
/// Room that the person's fingers need on a part to take it, m: the height of two fingers.
const ROOM: f64 = 0.04;
/// Setpoints may differ by this from the state from which a movement was planned, rad: rounding; a real difference is far
/// greater, and makes a step that the limiters refuse.
const EXACT: f64 = 1e-7;

impl Control {
    /// Asks for the movement that the skill needs: from rest at once, in motion from where the arm will be a moment later. An
    /// arm that is neither at rest nor at its planned speed comes to rest first.
    pub(crate) fn ask(&mut self, inputs: &Inputs) {
        let planning = &mut self.state.planning;
        planning.query = MovementQuery::NONE;
        if !self.can_ask() {
            self.state.planning.drop_query();
            return;
        }
        let (query, start) = if self.stands() {
            (MovementQuery::FROM_REST, self.servo.posture().map(MotionState::at_rest))
        } else {
            let lead = self.state.planning.lead;
            (
                MovementQuery::InMotion { begins: inputs.tick().saturating_add(lead) },
                self.state.arm.ahead(seconds(lead)),
            )
        };
        let asked = self.query(inputs, start);
        self.state.planning.open(query, asked.fingerprint());
        self.planner.ask(self.state.planning.newest, &asked);
    }

    /// Asks the planner of this instance what another one has asked, without a new query: where the movement begins is known.
    fn ask_as_well(&mut self, inputs: &Inputs) {
        let tick = inputs.tick();
        let start = match self.state.planning.query {
            MovementQuery::FromRest(_) if self.stands() => self.servo.posture().map(MotionState::at_rest),
            MovementQuery::InMotion { begins } if begins > tick && self.state.arm.is_at_planned_speed() => {
                self.state.arm.ahead(seconds(begins - tick))
            }
            _ => return self.ask(inputs),
        };
        let asked = self.query(inputs, start);
        self.planner.ask(self.state.planning.newest, &asked);
    }

    /// Whether it is known in which state a movement that is asked for now would begin.
    pub(crate) fn can_ask(&self) -> bool {
        self.state.arm.is_at_planned_speed() || self.stands()
    }

    /// Asks again, after a pause, what was refused.
    pub(crate) fn ask_again(&mut self, inputs: &Inputs) {
        let planning = &mut self.state.planning;
        planning.waited = planning.waited.saturating_add(1);
        if planning.is_due() {
            self.ask(inputs);
        }
    }

    /// Takes up the planned trajectory: one from rest at once, one from motion in the cycle for which it was planned.
    pub(crate) fn take_up_movement(&mut self, inputs: &Inputs) {
        self.settle(inputs.tick());
        let planning = &self.state.planning;
        if planning.query.is_open() && !self.planner.was_asked(planning.newest) {
            self.ask_as_well(inputs);
        }
        self.take_result(inputs.tick());
        match self.state.planning.query {
            MovementQuery::InMotion { begins } | MovementQuery::Planned { begins }
                if begins > inputs.tick() => {}
            MovementQuery::Planned { .. } => self.start_planned(inputs),
            MovementQuery::InMotion { .. } => {
                self.state.planning.lengthen_lead();
                self.ask(inputs);
            }
            MovementQuery::None(_) | MovementQuery::FromRest(_) => {}
        }
    }

    /// Takes the planner's answer to an open query, if it is there.
    fn take_result(&mut self, tick: u64) {
        let planning = &mut self.state.planning;
        let begins = match planning.query {
            MovementQuery::FromRest(_) => tick,
            MovementQuery::InMotion { begins } => begins,
            MovementQuery::None(_) | MovementQuery::Planned { .. } => return,
        };
        let Some(result) = self.planner.answer(planning.newest) else { return };
        if let Some(grip) = result.grip {
            self.state.hand.grip = Slot::of(grip);
        }
        match result.trajectory {
            Some(trajectory) => {
                planning.next = trajectory;
                planning.query = MovementQuery::Planned { begins };
            }
            None => self.be_refused(),
        }
    }

    /// Follows the planned trajectory, if the arm is where that begins, and if it can be stopped on it before it closes on the
    /// person: braking was verified along the present one. Else that goes on, and another one is asked for.
    fn start_planned(&mut self, inputs: &Inputs) {
        let next = self.state.planning.next;
        let (begin, here) = (next.posture(0.0), self.servo.posture());
        if (0..begin.len()).any(|joint| (begin[joint] - here[joint]).abs() > EXACT) {
            self.ask(inputs);
            return;
        }
        let present = self.state.arm;
        self.state.arm.follow(&next);
        if !next.begins_at_rest() && !self.can_brake_clear(inputs) {
            self.state.arm = present;
            self.ask(inputs);
            return;
        }
        self.state.planning.query = MovementQuery::NONE;
        self.state.arm.blocked = 0;
        self.state.skill.enter(SkillPhase::Move);
        self.state.decisions.note_movement(inputs.tick());
    }

    /// A refusal: an arm in motion brakes, for it goes where it shall not go; one at rest asks again later, and gives the
    /// action up after some refusals.
    fn be_refused(&mut self) {
        let planning = &mut self.state.planning;
        if let MovementQuery::InMotion { .. } = planning.query {
            planning.drop_query();
            self.state.arm.braking = Flag::Set;
        } else {
            planning.query = MovementQuery::NONE;
            planning.waited = 0;
            planning.refusals = planning.refusals.saturating_add(1);
            if self.state.skill.prepares.is_set() {
                self.state.skill.enter(SkillPhase::Idle);
            } else if planning.refusals >= MOST_REFUSALS && !self.state.skill.is_parking() {
                if self.state.skill.skill.brings_part() {
                    self.state.hand.refused = self.state.hand.refused.saturating_add(1);
                }
                self.give_up();
            }
        }
        if self.state.skill.phase() == SkillPhase::Move {
            self.state.skill.enter(SkillPhase::Plan);
        }
    }

    /// An arm that has braked to a stand rests there.
    fn settle(&mut self, tick: u64) {
        if !(self.state.arm.braking.is_set() && self.servo.arm_stands()) {
            return;
        }
        self.state.rest_arm(self.servo.posture(), tick);
        if self.state.skill.phase() == SkillPhase::Move {
            self.state.planning.drop_query();
            self.state.skill.enter(SkillPhase::Plan);
        }
    }

    /// Whether the arm stands, and will until it is told otherwise.
    fn stands(&self) -> bool {
        let still = self.state.arm_has_arrived() || self.state.arm.progress.stands();
        !self.state.arm.braking.is_set() && still && self.servo.arm_stands()
    }

    /// What is asked: all that the planner must know.
    fn query(&self, inputs: &Inputs, start: [MotionState; 7]) -> PlanningQuery {
        let (skill, hand, planning) = (&self.state.skill, &self.state.hand, &self.state.planning);
        let (next_use, next_place) = self.next_use();
        PlanningQuery {
            skill: skill.skill,
            kind: skill.kind.get(),
            place: skill.place.isometry(),
            next_use,
            next_place,
            stops_before: skill.stops_before.is_set(),
            prepares: skill.prepares.is_set(),
            loosely: planning.refusals >= LOOSELY,
            start,
            fingers: self.fingers(inputs),
            finger_target: std::array::from_fn(|joint| self.state.fingers.target[joint]),
            leave: self.leave(start),
            held: hand.held().map(|kind| (kind, hand.in_palm.isometry())),
            held_in: self.held_in(),
            person: self.person(inputs),
            surroundings: Surroundings::of(self.state.seen, inputs.obstacles()),
        }
    }

    /// What is done next with a part that is picked, or received, and where.
    fn next_use(&self) -> (NextUse, Option<Isometry3<f64>>) {
        let skill = &self.state.skill;
        let takes = matches!(skill.skill, Skill::Pick | Skill::Receive);
        let index = skill.action.get().filter(|_| takes);
        let action = index.and_then(|index| self.task.actions.get(index));
        match action.map(|action| (action.action_type, action.subgoal)) {
            Some((ActionType::Insert | ActionType::Receive | ActionType::Request, Some(subgoal))) => {
                (NextUse::Insert { depth: INSERTION_DEPTH }, Some(self.goals.socket(subgoal)))
            }
            Some((ActionType::Give, _)) => {
                (NextUse::HandOver { room: ROOM }, Some(self.goals.handover_frame()))
            }
            _ => (NextUse::Anything, None),
        }
    }

    /// Out of where the hand is: up with a part that was picked, else back as it came.
    fn leave(&self, start: [MotionState; 7]) -> Option<(Vector3<f64>, f64)> {
        let enclosed = self.state.arm.enclosed();
        if enclosed < OUT {
            return None;
        }
        let back = self.model.robot.palm(&start.map(|state| state.position)).rotation * -Vector3::z();
        let lifts = !self.state.hand.is_empty() && self.state.hand.from_table.is_set();
        Some(if lifts { (Vector3::z(), LIFT) } else { (back, RETREAT * enclosed) })
    }
}
