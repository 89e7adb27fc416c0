//! The legs of each errand, one after the other.

use crate::Control;
use crate::body::Fingers;
use crate::choice::Choice;
use crate::errand::{Errand, Leg};
use crate::senses::Senses;
use crate::servo::{arrived, progress};
use coact_messages::{ARM_JOINTS, NONE, PERSON, ROBOT};
use coact_robot::{HandGoal, Posture, PostureSearch};
use nalgebra::Point3;

/// The way to the park posture takes this much longer than it must.
const LEISURELY: f64 = 1.4;
/// Cycles for which something must be felt between the fingers, and for which that is waited for.
const FELT: (u64, u64) = (40, 400);
/// Cycles for which the person's hand must wait at the handover place before the robot takes the part, and for which
/// it must be at the part before the robot lets go.
const MET: (u64, u64) = (100, 300);
/// Share of the time of the way back after which the hand is clear, and the next movement may bend off.
const CLEAR: f64 = 0.6;
/// Grasps that may close on nothing before the action is given up for a while.
const MISSES: u64 = 3;

impl Control {
    /// Starts an errand: towards rest at once, towards anything else by searching the postures first.
    pub(crate) fn begin(&mut self, choice: &Choice, senses: &Senses) {
        let memory = &mut self.memory;
        if memory.action != choice.action {
            memory.misses = 0;
        }
        (memory.errand, memory.action, memory.kind) = (choice.errand as u64, choice.action, choice.kind);
        match self.goal(choice, senses) {
            Some(goal) => {
                let position = self.servo.position();
                self.memory.from.copy_from_slice(&position[..ARM_JOINTS]);
                self.memory.set_goal(&goal);
                self.memory.set_search(&PostureSearch::default());
                self.memory.enter(Leg::Plan);
            }
            None => {
                self.memory.errand = Errand::Park as u64;
                let park = self.body.robot.park;
                self.launch(&park, self.carrying(), LEISURELY);
                self.memory.enter(Leg::Park);
            }
        }
    }

    /// Where the hand must go for this errand.
    fn goal(&self, choice: &Choice, senses: &Senses) -> Option<HandGoal> {
        let kind = usize::try_from(choice.kind).ok().filter(|_| choice.kind < u64::from(NONE));
        match choice.errand {
            Errand::Park => None,
            Errand::Take => Some(self.places.part(kind?, &senses.part(ROBOT, kind?)?)),
            Errand::Place => {
                let subgoal = self.actions.get(choice.action as usize)?.subgoal?;
                Some(self.places.socket(kind?, subgoal))
            }
            Errand::PutBack => {
                let [x, y, _] = self.memory.taken_from;
                let at = if self.memory.taken == 1 { [x, y] } else { self.places.free_place(senses.parts()) };
                Some(self.places.on_table(kind?, at))
            }
            Errand::Ask => Some(self.places.held_out()),
            Errand::Receive | Errand::Offer => Some(self.places.exchange(kind?)),
            Errand::Steady => Some(self.places.steadying()),
            Errand::Point => {
                // The person is shown what lies at hand for the person.
                let part = senses.part(PERSON, kind?).or_else(|| senses.part(ROBOT, kind?))?;
                Some(self.places.pointing(&Point3::from(part.translation.vector)))
            }
        }
    }

    /// Carries the errand's present leg on, and enters the next one when it has ended.
    pub(crate) fn pursue(&mut self, senses: &Senses) {
        self.memory.leg_age = self.memory.leg_age.saturating_add(1);
        match self.memory.leg() {
            Leg::Rest => {}
            Leg::Plan => self.plan(),
            Leg::Await => self.await_part(senses),
            Leg::Stay => self.stay(senses),
            Leg::Feel => self.feel_part(senses),
            Leg::Lift | Leg::Retreat if progress(&self.memory) > CLEAR => self.memory.enter(Leg::Rest),
            _ if !arrived(&self.memory) => {}
            Leg::Park | Leg::Lift | Leg::Retreat => self.memory.enter(Leg::Rest),
            Leg::Reach => self.arrive_before(),
            Leg::Approach => self.arrive_at(),
            Leg::Close => self.memory.enter(Leg::Feel),
            Leg::Open => self.let_go(),
        }
    }

    fn plan(&mut self) {
        let (goal, from) = (self.memory.goal(), self.memory.from);
        let mut search = self.memory.search();
        let done = search.advance(&self.body.robot, &goal, &from, self.settings.search_budget);
        self.memory.set_search(&search);
        match done {
            None => {}
            Some(Some(reach)) => {
                self.launch(&reach.before, self.on_the_way(), 1.0);
                self.memory.enter(Leg::Reach);
            }
            Some(None) => {
                self.finish(true);
                self.memory.enter(Leg::Rest);
            }
        }
    }

    fn arrive_before(&mut self) {
        let carries = self.memory.held().is_some();
        match self.memory.errand() {
            Errand::Receive => self.memory.enter(Leg::Await),
            Errand::Ask | Errand::Point => self.memory.enter(Leg::Stay),
            Errand::Steady if carries => self.memory.enter(Leg::Await),
            _ => self.approach(),
        }
    }

    fn arrive_at(&mut self) {
        match self.memory.errand() {
            Errand::Take | Errand::Receive => self.grip(Leg::Close),
            Errand::Place | Errand::PutBack if self.memory.held().is_some() => self.grip(Leg::Open),
            Errand::Place | Errand::PutBack => self.go_back(Leg::Retreat),
            _ => self.memory.enter(Leg::Stay),
        }
    }

    /// Waits before the handover place until the person's hand waits there with the part.
    fn await_part(&mut self, senses: &Senses) {
        let offered = self.memory.kind().is_some_and(|kind| senses.in_person_hand(kind))
            && senses.person_waits_at(&self.places.handover());
        self.memory.met = if offered { self.memory.met + 1 } else { 0 };
        if self.memory.errand() == Errand::Receive && self.memory.met >= MET.0 {
            self.approach();
        }
    }

    /// Stays at the goal; a part held out is let go once the person's hand has it.
    fn stay(&mut self, senses: &Senses) {
        let kind = self.memory.kind().unwrap_or_default();
        let met = senses.person_waits_at(&self.places.handover()) && senses.person_can_take(kind);
        self.memory.met = if met { self.memory.met + 1 } else { 0 };
        if self.memory.errand() == Errand::Offer && self.memory.met >= MET.1 {
            self.grip(Leg::Open);
        }
    }

    fn feel_part(&mut self, senses: &Senses) {
        match senses.touch() {
            Some(true) => self.memory.touched += 1,
            Some(false) => self.memory.touched = 0,
            None => {}
        }
        if self.memory.touched >= FELT.0 {
            let point = self.memory.goal().point;
            self.memory.held = self.memory.kind;
            self.memory.misses = 0;
            self.memory.taken = u64::from(self.memory.errand() == Errand::Take);
            self.memory.taken_from = point.coords.into();
            self.go_back(Leg::Lift);
        } else if self.memory.leg_age > FELT.1 {
            self.memory.misses += 1;
            if self.memory.misses >= MISSES {
                self.finish(true);
            }
            self.grip(Leg::Open);
        }
    }

    /// The fingers have opened: what they held is where it belongs.
    fn let_go(&mut self) {
        if self.memory.held().is_some() {
            self.memory.held = NONE.into();
            self.finish(false);
        }
        self.go_back(Leg::Retreat);
    }

    /// The action is done, or given up: the same decision does not start it again.
    fn finish(&mut self, failed: bool) {
        let memory = &mut self.memory;
        (memory.finished, memory.finished_since) = (memory.action, memory.since);
        (memory.finished_age, memory.failed) = (0, u64::from(failed));
    }

    fn approach(&mut self) {
        let at = self.memory.reach[1];
        self.launch(&at, self.on_the_way(), 1.0);
        self.memory.enter(Leg::Approach);
    }

    /// Back along the approach, fingers as they are.
    pub(crate) fn go_back(&mut self, leg: Leg) {
        let mut target = self.memory.target;
        target[..ARM_JOINTS].copy_from_slice(&self.memory.reach[0]);
        self.servo.launch(&mut self.memory, target, 1.0);
        self.memory.enter(leg);
    }

    /// Closes or opens the fingers where the hand is.
    fn grip(&mut self, leg: Leg) {
        let width = self.memory.kind().map_or(0.0, |kind| self.places.width(kind));
        let fingers = if leg == Leg::Close { Fingers::On(width) } else { Fingers::Around(width) };
        let at = self.memory.reach[1];
        self.launch(&at, fingers, 1.0);
        self.memory.enter(leg);
    }

    fn launch(&mut self, arm: &Posture, fingers: Fingers, slowness: f64) {
        let target = self.body.angles(arm, fingers);
        self.servo.launch(&mut self.memory, target, slowness);
    }

    /// What the fingers do on the way to the errand's goal.
    fn on_the_way(&self) -> Fingers {
        let width = self.memory.kind().map_or(0.0, |kind| self.places.width(kind));
        match self.memory.errand() {
            _ if self.memory.held().is_some() => self.carrying(),
            Errand::Take | Errand::Receive => Fingers::Around(width),
            Errand::Ask => Fingers::HeldOut,
            Errand::Steady | Errand::Point => Fingers::Slender,
            _ => Fingers::Relaxed,
        }
    }

    /// Closed on what is held, else relaxed.
    fn carrying(&self) -> Fingers {
        self.memory.held().map_or(Fingers::Relaxed, |held| Fingers::On(self.places.width(held)))
    }
}
