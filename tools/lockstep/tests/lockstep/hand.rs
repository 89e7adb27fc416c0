//! A program that knows the table and sends nothing but where a hand is builds the vehicle with the robot.
#![allow(clippy::unwrap_used)]

use crate::shipped::settings;
use coact_joint_task::Agent;
use coact_lockstep::Lockstep;
use coact_messages::{HandPoints, Plausible};
use coact_monitor::{Anticipation, Intentions};
use coact_period::cycles;
use coact_person::{FINGERS, HandModel, Holder, PartsView};
use coact_run_records::{ActionEvent, Event};
use glam::DVec3;
use std::f64::consts::PI;
use std::time::Duration;

/// From one hand that is told to the next, cycles: 60 Hz.
const FRAME: u64 = 17;
/// Pitch of the hand that grasps to insert, that hands over, and that is held out, rad.
const TOP: f64 = -75.0 / 180.0 * PI;
const SIDE: f64 = -10.0 / 180.0 * PI;
const FLAT: f64 = 0.0;
/// How far fingers open beyond what they grasp, m.
const OPEN: f64 = 0.035;
/// Time of a reach and of a carrying movement, cycles.
const REACH: u64 = cycles(Duration::from_millis(700));
const CARRY: u64 = cycles(Duration::from_millis(900));
/// How long anything is waited for.
const PATIENCE: u64 = cycles(Duration::from_secs(60));

/// The middle between the finger tips, m, pitch, rad, and aperture, m.
type Hand = (DVec3, f64, f64);

/// Moves a hand along movements of minimum jerk. It looks at the table as a person does, and at nothing else.
struct Sender {
    stages: Lockstep,
    model: HandModel,
    hand: Hand,
    /// Whether it is told of.
    tells: bool,
    watch: Anticipation,
    events: Vec<Event>,
}

impl Sender {
    fn new(seed: u64) -> Self {
        let stages = Lockstep::new(&settings(seed, "hand")).unwrap();
        let model = HandModel::new(&stages.task().scene);
        let hand = (model.centre(&model.rest()), -0.35, 0.03);
        let watch = Anticipation::new(stages.task(), Intentions::from(stages.plan()));
        Self { stages, model, hand, tells: true, watch, events: Vec::new() }
    }

    fn step(&mut self) {
        if self.tells && self.stages.ticks().is_multiple_of(FRAME) {
            let (centre, pitch, aperture) = self.hand;
            let position = self.model.reaching(centre, pitch, aperture).map(|point| point.to_array());
            let message = HandPoints { position, ..bytemuck::Zeroable::zeroed() };
            assert_eq!(message.check(), Ok(()));
            self.stages.show_hand(&message.position);
        }
        self.stages.step();
        self.watch.observe(&self.stages.truth, &self.stages.frame, &mut self.events);
    }

    fn stay(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.step());
    }

    fn wait_for(&mut self, what: &str, so: impl Fn(&Self) -> bool) {
        let begun = self.stages.ticks();
        while !so(self) {
            self.step();
            let achieved = self.stages.truth.achieved;
            assert!(self.stages.ticks() < begun + PATIENCE, "{what} does not come; achieved {achieved:09b}");
        }
    }

    /// A movement to `to` that is lifted by `arch`; on the way the fingers are `opened` m apart.
    fn go(&mut self, to: Hand, ticks: u64, arch: f64, opened: f64) {
        let from = self.hand;
        let jerkless = |t: f64| {
            let t = t.clamp(0.0, 1.0);
            t * t * t * (10.0 + t * (-15.0 + 6.0 * t))
        };
        for step in 1..=ticks {
            let time = step as f64 / ticks as f64;
            let (along, early, late) = (jerkless(time), jerkless(time / 0.7), jerkless((time - 0.7) / 0.3));
            let lift = arch * 16.0 * along * along * (1.0 - along) * (1.0 - along);
            self.hand = (
                from.0.lerp(to.0, along) + lift * DVec3::Z,
                from.1 + early * (to.1 - from.1),
                from.2 + early * (opened - from.2) + late * (to.2 - opened),
            );
            self.step();
        }
    }

    fn parts(&self) -> PartsView<'_> {
        self.stages.parts()
    }

    fn centre(&self, part: usize) -> DVec3 {
        self.parts().centre(part, self.stages.task())
    }

    /// Thumb to index around a part.
    fn around(&self, part: usize) -> f64 {
        self.stages.task().kinds[self.parts().kind(part)].width + FINGERS
    }

    /// A part of this kind that lies in somebody's workspace.
    fn lying(&self, kind: &str, with: Agent) -> usize {
        let task = self.stages.task();
        let kind = task.kinds.iter().position(|own| own.name == kind).unwrap();
        self.parts().nearest_free(kind, with, DVec3::from(task.scene.person_rest), task).unwrap()
    }

    fn goal(&self, name: &str) -> usize {
        self.stages.task().subgoals.iter().position(|goal| goal.name == name).unwrap()
    }

    fn is_achieved(&self, goal: usize) -> bool {
        self.parts().achieved() & (1 << goal) != 0
    }

    fn grasp(&mut self, part: usize, pitch: f64) {
        let around = self.around(part);
        self.go((self.centre(part), pitch, around), REACH, 0.015, around + OPEN);
        self.stay(120);
    }

    fn open_and_rest(&mut self) {
        let (at, pitch, aperture) = self.hand;
        self.go((at, pitch, aperture + OPEN), 150, 0.0, aperture + OPEN);
        let rest = self.model.centre(&self.model.rest());
        self.go((rest, -0.35, 0.03), REACH, 0.03, aperture + OPEN);
        self.stay(1_000);
    }

    /// Carries the part that it has to its socket, waits a little for the robot, and lets go.
    fn insert(&mut self, part: usize, goal: usize) {
        let subgoal = self.stages.task().subgoals[goal].clone();
        let half = 0.5 * self.stages.task().kinds[subgoal.kind].shape.height();
        let place = DVec3::from(subgoal.socket) + half * DVec3::from(subgoal.axis);
        let around = self.around(part);
        self.go((place, TOP, around), CARRY, 0.06, around);
        self.stay(1_500);
        self.open_and_rest();
        assert!(self.is_achieved(goal), "{} is not achieved", subgoal.name);
    }

    fn takes_and_inserts(&mut self, kind: &str, goal: &str) {
        let (part, goal) = (self.lying(kind, Agent::Person), self.goal(goal));
        self.grasp(part, TOP);
        self.insert(part, goal);
    }

    fn hands_over(&mut self, kind: &str) {
        let part = self.lying(kind, Agent::Person);
        self.grasp(part, SIDE);
        let around = self.around(part);
        let handover = DVec3::from(self.stages.task().scene.handover);
        let half = 0.5 * self.stages.task().kinds[self.parts().kind(part)].shape.height();
        self.go((handover + half * DVec3::Z, SIDE, around), CARRY, 0.06, around);
        // That the robot's fingers have closed can be seen.
        self.wait_for("the robot's hand", |own| own.stages.sample.joints.touch > 1.0);
        self.stay(300);
        self.open_and_rest();
    }

    fn requests_and_inserts(&mut self, kind: &str, goal: &str) {
        let (part, goal) = (self.lying(kind, Agent::Robot), self.goal(goal));
        let handover = DVec3::from(self.stages.task().scene.handover);
        let short = handover - DVec3::new(0.10, 0.0, 0.0);
        self.go((short, FLAT, 0.11), REACH, 0.015, 0.11);
        self.wait_for("the requested part", |own| {
            own.parts().is(part, Holder::Robot) && own.centre(part).distance(handover) < 0.05
        });
        self.stay(700);
        self.grasp(part, TOP);
        self.wait_for("the robot's letting go", |own| own.parts().is(part, Holder::Person));
        self.stay(200);
        self.insert(part, goal);
    }

    fn actions(&self) -> Vec<&ActionEvent> {
        let actions = self.events.iter().map(|event| match event {
            Event::Action(action) => Some(action),
            _ => None,
        });
        actions.flatten().collect()
    }
}

#[test]
fn the_vehicle_is_built_by_a_hand_from_outside_and_understood_before_its_grasps() {
    let mut sender = Sender::new(1);
    sender.stay(1_500);
    sender.takes_and_inserts("wheel", "wheel on the person's side");
    sender.requests_and_inserts("nut", "nut on the person's side");
    sender.hands_over("wheel");
    let nut = sender.goal("nut on the robot's side");
    sender.wait_for("the robot's nut", |own| own.is_achieved(nut));
    sender.stay(500);
    sender.hands_over("column 1");
    let column = sender.goal("column 1 in its hole");
    sender.wait_for("column 1", |own| own.is_achieved(column));
    sender.stay(500);
    sender.takes_and_inserts("column 2", "column 2 in its hole");
    sender.takes_and_inserts("column 4", "column 4 in its hole");
    sender.wait_for("the rest of the vehicle", |own| own.stages.complete());
    let actions = sender.actions();
    for action in &actions {
        println!(
            "{} {}: set out at {} ms, grasped at {} ms, {:?} decided {:?} ms before, expected {:?}",
            action.chain,
            action.kind,
            action.onset_ms,
            action.grasp_ms,
            action.decided,
            action.lead_ms,
            action.expected
        );
    }
    println!("complete after {} ms", sender.stages.ticks());
    let chains: Vec<_> = actions.iter().map(|action| (action.chain.as_str(), action.kind.as_str())).collect();
    let expected = [
        ("insert", "wheel"),
        ("request", "nut"),
        ("insert", "nut"),
        ("hand over", "wheel"),
        ("hand over", "column 1"),
        ("insert", "column 2"),
        ("insert", "column 4"),
    ];
    assert_eq!(chains, expected);
    for action in &actions {
        assert!((200..900).contains(&(action.grasp_ms - action.onset_ms)), "{action:?}");
    }
    let before = actions.iter().filter(|action| action.correct && action.lead_ms > Some(0)).count();
    assert!(before >= 6, "{before} of 7 decided rightly before the grasp");
}

#[test]
fn without_a_hand_from_outside_nobody_is_seen() {
    let mut stages = Lockstep::new(&settings(1, "hand")).unwrap();
    for _ in 0..3_000 {
        stages.step();
        assert!(!stages.percept.arms[0].is_tracked());
    }
    assert_eq!(stages.truth.arms[0], [[0.0; 3]; 4]);
}

#[test]
fn a_hand_that_nobody_told_of_for_a_while_still_has_its_part_if_it_comes_back_closed() {
    for comes_back_closed in [true, false] {
        let mut person = Sender::new(5);
        person.stay(500);
        let wheel = person.lying("wheel", Agent::Person);
        person.grasp(wheel, TOP);
        person.go(
            (person.hand.0 + 0.15 * DVec3::Z, TOP, person.around(wheel)),
            REACH,
            0.0,
            person.around(wheel),
        );
        let left = person.centre(wheel);
        person.tells = false;
        let aperture = person.around(wheel) + if comes_back_closed { 0.0 } else { OPEN };
        person.go((person.hand.0 + DVec3::new(0.05, 0.20, 0.0), TOP, aperture), 300, 0.0, aperture);
        assert!(
            person.centre(wheel).distance(left) < 0.08,
            "while nobody tells of it, it stays where it was"
        );
        person.tells = true;
        person.stay(10 * FRAME);
        let away = person.centre(wheel).distance(person.hand.0);
        assert_eq!(away < 0.05, comes_back_closed, "{away}");
    }
}
