//! Between the servo and the planner: questions, and the movements that answer them.

use crate::Control;
use crate::errand::{Errand, Leg};
use crate::memory::{LEAD, pose};
use crate::planner::GUIDE;
use crate::request::Request;
use crate::senses::Senses;
use crate::servo::PERIOD;
use coact_joint_task::ActionType;
use coact_messages::{ARM_JOINTS, MAX_PARTS};
use coact_robot::{MotionState, NextUse};
use nalgebra::{Isometry3, Vector3};

/// Cycles after which a question that was refused is asked again.
const AGAIN: u64 = 300;
/// Refusals after which a part is put down as it comes.
const LOOSELY: u64 = 3;
/// How far the hand backs out of where it is, with a part and without, m.
const LIFT: f64 = 0.06;
const RETREAT: f64 = 0.10;
/// A hand less far in a narrow place than this share of the way is out of it.
const OUT: f64 = 0.05;
/// Height of a part that a person needs to take it, m: two fingers.
const ROOM: f64 = 0.04;
/// Setpoints may differ by this from the state for which a movement was planned, rad.
const EXACT: f64 = 1e-7;

impl Control {
    /// Asks for the movement that the errand needs: from rest at once, in motion from where the arm will be a moment
    /// later. An arm that is neither at rest nor at its full pace comes to rest first.
    pub(crate) fn ask(&mut self, senses: &Senses) {
        (self.memory.begins, self.memory.ready) = (0, 0);
        if !self.can_ask() {
            (self.memory.asking, self.memory.waited) = (0, AGAIN);
            return;
        }
        let start = if self.stands() {
            self.servo.posture().map(MotionState::at_rest)
        } else {
            self.memory.begins = senses.tick() + self.memory.lead;
            self.memory.course.at(self.memory.elapsed + self.memory.lead as f64 * PERIOD)
        };
        self.memory.questions += 1;
        (self.memory.asking, self.memory.waited) = (1, 0);
        let request = self.request(senses, start);
        self.planning.ask(&request);
    }

    /// Whether it is known in which state a movement that is asked for now would begin.
    pub(crate) fn can_ask(&self) -> bool {
        let steady = self.memory.arm_halted == 0 && self.memory.pace == 1.0 && self.memory.pace_change == 0.0;
        steady || self.stands()
    }

    /// Asks again what was refused.
    pub(crate) fn ask_again(&mut self, senses: &Senses) {
        self.memory.waited += 1;
        if self.memory.waited > AGAIN && self.memory.asking == 0 && self.memory.begins == 0 {
            self.ask(senses);
        }
    }

    /// Takes an answer up: a movement from rest begins at once, one from motion in the cycle for which it was planned.
    pub(crate) fn take_up_movement(&mut self, senses: &Senses) {
        self.settle();
        if self.memory.asking == 1 && !self.planning.was_asked(self.memory.questions) {
            // It was a predecessor's question.
            self.ask(senses);
        }
        let answer = (self.memory.asking == 1).then(|| self.planning.answer(self.memory.questions)).flatten();
        if let Some(answer) = answer {
            self.memory.asking = 0;
            self.memory.withdraws = u64::from(answer.withdraws);
            self.memory.hold = answer.hold.map_or(self.memory.hold, |hold| hold as u64);
            match answer.course {
                Some(course) => (self.memory.next, self.memory.ready) = (course, 1),
                None => self.be_without_movement(),
            }
        }
        if self.memory.begins > senses.tick() {
            return;
        }
        let was_due = std::mem::take(&mut self.memory.begins) > 0;
        if self.memory.ready == 1 {
            self.start_next(senses);
        } else if was_due {
            // The answer is late: it gets more time.
            self.memory.lead = (2 * self.memory.lead).min(LEAD.1);
            self.ask(senses);
        }
    }

    /// Follows the planned movement, if the arm is where that begins.
    fn start_next(&mut self, senses: &Senses) {
        self.memory.ready = 0;
        let begin = self.memory.next.posture(0.0);
        let here = self.servo.posture();
        if (0..begin.len()).any(|joint| (begin[joint] - here[joint]).abs() > EXACT) {
            self.ask(senses);
            return;
        }
        let next = self.memory.next;
        self.memory.follow(&next);
        self.memory.blocked = 0;
        self.memory.enter(Leg::Move);
        self.note_reaction(senses);
    }

    /// A refusal: an arm in motion brakes, for it goes where it shall not go; one at rest asks again later.
    fn be_without_movement(&mut self) {
        self.memory.waited = 0;
        if self.memory.begins > 0 {
            (self.memory.begins, self.memory.arm_halted) = (0, 1);
            self.memory.waited = AGAIN;
        } else {
            self.be_refused();
        }
        if self.memory.leg() == Leg::Move {
            self.memory.enter(Leg::Plan);
        }
    }

    /// After braking, the arm stands where it stands.
    fn settle(&mut self) {
        if self.memory.arm_halted == 1 && self.servo.arm_stands() {
            self.memory.inside = self.inside();
            let course = crate::course::Course::resting(self.servo.posture());
            self.memory.follow(&course);
            if self.memory.leg() == Leg::Move {
                (self.memory.asking, self.memory.waited) = (0, AGAIN);
                self.memory.enter(Leg::Plan);
            }
        }
    }

    /// Whether the arm stands, and will until it is told otherwise.
    fn stands(&self) -> bool {
        let still = self.memory.arrived() || self.memory.pace == 0.0;
        self.memory.arm_halted == 0 && still && self.servo.arm_stands()
    }

    /// How far the hand is in a narrow place, as a share of the way into it.
    fn inside(&self) -> f64 {
        let course = &self.memory.course;
        if course.duration() > 0.0 { course.inside(self.memory.elapsed) } else { self.memory.inside }
    }

    /// What is asked: all that the planner must know.
    fn request(&self, senses: &Senses, start: [MotionState; 7]) -> Request {
        let held = self.memory.held().map(|kind| (kind, pose(self.memory.in_palm)));
        let (purpose, next) = self.purpose();
        let mut request = Request {
            id: self.memory.questions,
            errand: self.memory.errand(),
            kind: self.memory.kind(),
            frame: pose(self.memory.place),
            purpose,
            next,
            before: self.memory.before == 1,
            loosely: self.memory.refusals >= LOOSELY,
            start,
            fingers: std::array::from_fn(|joint| self.servo.joints[ARM_JOINTS + joint].position),
            heading: std::array::from_fn(|joint| self.memory.finger_target[joint]),
            leave: self.leave(start),
            held,
            hold: self.hold(),
            parts: [bytemuck::Zeroable::zeroed(); MAX_PARTS],
            seen: 0,
            screens: [[0.0; 6]; 4],
            screened: 0,
            person: senses.person_arm(&self.body.hulls),
        };
        senses.surroundings(&mut request);
        request
    }

    /// What is done next with a part that is taken, and where.
    fn purpose(&self) -> (NextUse, Option<Isometry3<f64>>) {
        let taking = self.memory.errand() == Errand::Take;
        let action = self.actions.get(self.memory.action as usize).filter(|_| taking);
        match action.map(|action| (action.action_type, action.subgoal)) {
            Some((ActionType::Insert, Some(subgoal))) => {
                (NextUse::Insert { depth: GUIDE }, Some(self.places.socket(subgoal)))
            }
            Some((ActionType::Give, _)) => (NextUse::HandOver { room: ROOM }, Some(self.places.meeting())),
            _ => (NextUse::Anything, None),
        }
    }

    /// Out of where the hand is: up with a part that was taken, else back as it came.
    fn leave(&self, start: [MotionState; 7]) -> Option<(Vector3<f64>, f64)> {
        let inside = self.inside();
        if inside < OUT {
            return None;
        }
        let back = self.body.robot.palm(&start.map(|state| state.position)).rotation * -Vector3::z();
        let lifts = self.memory.held().is_some() && self.memory.taken == 1;
        Some(if lifts { (Vector3::z(), LIFT) } else { (back, RETREAT * inside) })
    }
}
