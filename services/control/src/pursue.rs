//! The legs of each errand, one after the other.

use crate::Control;
use crate::body::Fingers;
use crate::choice::Choice;
use crate::errand::{Errand, Leg};
use crate::memory::{self, pose};
use crate::senses::Senses;
use coact_messages::{NONE, PERSON, ROBOT};
use nalgebra::{Isometry3, Vector3};

/// Cycles for which something must be felt between the fingers, and for which that is waited for.
const FELT: (u64, u64) = (40, 400);
/// Cycles for which the person's hand must wait at the handover place before the robot takes the part.
const MET: u64 = 100;
/// Force of the person at which the robot lets a part go, N, and for how many cycles it must last; below the second the
/// person has let go.
const PULL: [f64; 2] = [1.5, 0.3];
const PULLED: u64 = 30;
/// Camera frames in which the part in the hand is looked at, and how near it must be to where it was gripped, m.
const LOOKED: u64 = 4;
const IN_SIGHT: f64 = 0.05;
/// Cycles after which a handover that does not come about is given up.
const PATIENCE: u64 = 30_000;
/// Grasps that may close on nothing, and movements that may be refused, before the action is given up for a while.
const MISSES: u64 = 3;
const REFUSALS: u64 = 10;
/// A part that has moved farther than this while the hand reaches for it is followed, m.
const MOVED: f64 = 0.008;
/// Cycles for which the person may be in the way before the arm stops and another way is looked for.
const BLOCKED: u64 = 250;

impl Control {
    /// Starts an errand: towards rest when what it is about is not there.
    pub(crate) fn begin(&mut self, choice: &Choice, senses: &Senses) {
        let memory = &mut self.memory;
        if memory.action != choice.action {
            memory.misses = 0;
        }
        (memory.errand, memory.action, memory.kind) = (choice.errand as u64, choice.action, choice.kind);
        memory.refusals = 0;
        match self.place(senses) {
            Some(place) => self.memory.place = memory::words(&place),
            None => self.memory.errand = Errand::Park as u64,
        }
        self.memory.before = u64::from(self.memory.errand() == Errand::Receive);
        self.memory.enter(Leg::Plan);
        self.ask(senses);
    }

    /// Where the errand leads: the frame of a part or of a place; at rest none is needed.
    fn place(&self, senses: &Senses) -> Option<Isometry3<f64>> {
        let kind = self.memory.kind();
        match self.memory.errand() {
            Errand::Park => None,
            Errand::Take => senses.part(ROBOT, kind?).map(|seen| self.places.above_table(seen)),
            Errand::Place => {
                Some(self.places.socket(self.actions.get(self.memory.action as usize)?.subgoal?))
            }
            Errand::PutBack => {
                let [x, y, _] = self.memory.taken_from;
                let at = if self.memory.taken == 1 { [x, y] } else { self.places.free_place(senses.parts()) };
                Some(self.places.on_table(at))
            }
            Errand::Ask | Errand::Receive | Errand::Offer => Some(self.places.meeting()),
            Errand::Steady => Some(Isometry3::identity()),
            // The person is shown what lies at hand for the person.
            Errand::Point => senses.part(PERSON, kind?).or_else(|| senses.part(ROBOT, kind?)),
        }
    }

    /// Carries the errand's present leg on, and enters the next one when it has ended.
    pub(crate) fn pursue(&mut self, senses: &Senses) {
        self.memory.leg_age = self.memory.leg_age.saturating_add(1);
        self.take_up_movement(senses);
        match self.memory.leg() {
            Leg::Rest => {}
            Leg::Plan | Leg::Move if self.servo.arm_stands() && self.is_taken(senses) => {
                // The person comes to meet a hand that does not get on: no movement begins any more.
                (self.memory.asking, self.memory.begins, self.memory.ready) = (0, 0, 0);
                self.memory.arm_halted = 1;
                self.grip(Leg::Open);
            }
            Leg::Plan => self.ask_again(senses),
            Leg::Move => self.go_on(senses),
            Leg::Await => self.await_part(senses),
            Leg::Stay => self.stay(senses),
            Leg::Feel => self.feel_part(senses),
            Leg::Close if self.memory.fingers_arrived() => self.memory.enter(Leg::Feel),
            Leg::Open => self.open(senses),
            Leg::Close => {}
        }
    }

    /// On the way: the fingers follow once the hand has left; a part that moves is followed, a person in the way is
    /// gone around.
    fn go_on(&mut self, senses: &Senses) {
        self.shape_fingers();
        if self.memory.asking == 1 || self.memory.begins > 0 {
            return;
        }
        if self.memory.arm_halted == 1 {
            self.memory.enter(Leg::Plan);
        } else if self.memory.arrived() && self.memory.fingers_arrived() {
            self.arrive(senses);
        } else if let Some(place) = self.moved_target(senses).filter(|_| self.can_ask()) {
            self.memory.place = memory::words(&place);
            self.ask(senses);
        } else if self.memory.blocked > BLOCKED {
            (self.memory.blocked, self.memory.arm_halted) = (0, 1);
        }
    }

    /// The fingers take the shape that the errand needs, from when the hand has left the place where it was, or where there
    /// is room for that.
    fn shape_fingers(&mut self) {
        let (errand, kind) = (self.memory.errand(), self.memory.kind());
        let wanted = self.body.finger_joints(self.body.on_the_way(errand, kind, self.hold()));
        let may_move = self.memory.begins == 0 && self.memory.elapsed >= self.memory.course.preshapes;
        if may_move && self.memory.finger_target != wanted {
            self.servo.launch_fingers(&mut self.memory, wanted);
        }
    }

    /// Where the part lies that is reached for, if that is elsewhere than it was and the hand is not yet going into it.
    fn moved_target(&self, senses: &Senses) -> Option<Isometry3<f64>> {
        if self.memory.errand() != Errand::Take || self.memory.elapsed >= self.memory.course.approaches {
            return None;
        }
        let place = self.place(senses)?;
        let way = (place.translation.vector - pose(self.memory.place).translation.vector).norm();
        (way > MOVED).then_some(place)
    }

    fn arrive(&mut self, senses: &Senses) {
        match self.memory.errand() {
            _ if self.memory.withdraws == 1 => {
                self.memory.enter(Leg::Plan);
                self.ask(senses);
            }
            Errand::Park => self.memory.enter(Leg::Rest),
            Errand::Receive if self.memory.before == 1 => self.memory.enter(Leg::Await),
            Errand::Take | Errand::Receive => self.grip(Leg::Close),
            Errand::Place | Errand::PutBack if self.memory.held().is_some() => self.grip(Leg::Open),
            Errand::Place | Errand::PutBack => self.memory.enter(Leg::Rest),
            Errand::Ask | Errand::Offer | Errand::Steady | Errand::Point => self.memory.enter(Leg::Stay),
        }
    }

    /// Waits before the handover place until the person's hand waits there with the part.
    fn await_part(&mut self, senses: &Senses) {
        let offered = self.memory.kind().is_some_and(|kind| senses.in_person_hand(kind))
            && senses.person_waits_at(&self.places.handover());
        let pressed = senses.pull().is_some_and(|force| force > PULL[1]);
        self.memory.met = if offered { self.memory.met + 1 } else { 0 };
        if self.memory.met >= MET || (offered && pressed) {
            self.memory.before = 0;
            self.memory.enter(Leg::Plan);
            self.ask(senses);
        } else if self.memory.leg_age > PATIENCE {
            self.give_up();
        }
    }

    /// Stays at the goal; a part held out is let go when the person pulls at it.
    fn stay(&mut self, senses: &Senses) {
        if self.is_taken(senses) {
            self.grip(Leg::Open);
        } else if self.memory.errand() == Errand::Offer && self.memory.leg_age > PATIENCE {
            self.give_up();
        }
    }

    /// Whether the person has pulled for a while at the part that the robot is about to give.
    fn is_taken(&mut self, senses: &Senses) -> bool {
        let offered = self.memory.held().filter(|_| self.memory.errand() == Errand::Offer);
        let can_take = offered.is_some_and(|kind| senses.person_can_take(kind));
        let pulls = can_take && senses.pull().is_some_and(|force| force > PULL[0]);
        self.memory.pulled = if pulls { self.memory.pulled + 1 } else { 0 };
        self.memory.pulled >= PULLED
    }

    fn feel_part(&mut self, senses: &Senses) {
        match senses.touch() {
            Some(true) => self.memory.touched += 1,
            Some(false) => self.memory.touched = 0,
            None => {}
        }
        if self.memory.held().is_some() {
            // Closed again on what was to be given: it is there still, or lost.
            if self.memory.touched >= FELT.0 {
                self.memory.enter(Leg::Stay);
            } else if self.memory.leg_age > FELT.1 {
                self.memory.held = NONE.into();
                self.memory.enter(Leg::Rest);
            }
        } else if self.memory.touched >= FELT.0 && self.has_seen_what_it_holds(senses) {
            let palm = self.body.robot.palm(&self.servo.posture());
            let frame = pose(self.memory.place);
            let mut in_palm = palm.inverse() * frame;
            if self.memory.sightings > 0 {
                // Closing fingers push a part to where they meet: it is where it is seen now.
                in_palm.translation.vector = Vector3::from(self.memory.seen) / self.memory.sightings as f64;
            }
            self.memory.in_palm = memory::words(&in_palm);
            self.memory.held = self.memory.kind;
            self.memory.misses = 0;
            self.memory.taken = u64::from(self.memory.errand() == Errand::Take);
            self.memory.taken_from = frame.translation.vector.into();
            self.memory.enter(Leg::Rest);
        } else if self.memory.leg_age > FELT.1 {
            self.memory.misses += 1;
            if self.memory.misses >= MISSES {
                self.finish(true);
            }
            self.grip(Leg::Open);
        }
    }

    /// Looks at what the fingers have closed on; true once some camera frames have shown it, or none does in time.
    fn has_seen_what_it_holds(&mut self, senses: &Senses) -> bool {
        let expected = pose(self.memory.place).translation.vector.into();
        let since = senses.tick().saturating_sub(self.memory.leg_age);
        let seen = self.memory.kind().and_then(|kind| senses.sighting(kind, &expected, IN_SIGHT));
        if let Some((frame, at)) = seen.filter(|(frame, _)| *frame >= since && *frame != self.memory.seen_in)
        {
            let in_palm = self.body.robot.palm(&self.servo.posture()).inverse() * at;
            let sum = Vector3::from(self.memory.seen) + in_palm.translation.vector;
            self.memory.seen = sum.into();
            self.memory.sightings += 1;
            self.memory.seen_in = frame;
        }
        self.memory.sightings >= LOOKED || self.memory.leg_age > FELT.1
    }

    /// Opens the fingers; they close again on a part that the person has let go before they did.
    fn open(&mut self, senses: &Senses) {
        let gives = self.memory.errand() == Errand::Offer && self.memory.held().is_some();
        let alone = senses.pull().is_some_and(|force| force < PULL[1]) && senses.touch() == Some(true);
        if gives && alone {
            self.grip(Leg::Close);
        } else if self.memory.fingers_arrived() {
            self.let_go();
        }
    }

    /// The fingers have opened: what they held is where it belongs.
    fn let_go(&mut self) {
        if self.memory.held().is_some() {
            self.memory.held = NONE.into();
            self.finish(false);
        }
        self.memory.enter(Leg::Rest);
    }

    /// The action is given up: the same decision does not start it again for a while.
    pub(crate) fn give_up(&mut self) {
        self.finish(true);
        self.memory.enter(Leg::Rest);
    }

    /// Counts a refused movement; after some the action is given up.
    pub(crate) fn be_refused(&mut self) {
        self.memory.refusals += 1;
        if self.memory.refusals >= REFUSALS && self.memory.errand() != Errand::Park {
            self.give_up();
        }
    }

    /// The action is done, or given up: the same decision does not start it again.
    fn finish(&mut self, failed: bool) {
        let memory = &mut self.memory;
        (memory.finished, memory.finished_since) = (memory.action, memory.since);
        (memory.finished_age, memory.failed) = (0, u64::from(failed));
    }

    /// Closes or opens the fingers where the hand is.
    fn grip(&mut self, leg: Leg) {
        let hold = self.memory.kind().map(|kind| self.body.holds.known(self.memory.hold, kind));
        let shape = if leg == Leg::Close { Fingers::On } else { Fingers::Off };
        let fingers = hold.map_or(Fingers::Relaxed, shape);
        self.servo.launch_fingers(&mut self.memory, self.body.finger_joints(fingers));
        self.memory.enter(leg);
    }
}
