//! A hand that is told from outside grasps, carries and lets go by its fingers alone, and what it did is found from that.
#![allow(clippy::unwrap_used)]

use crate::scene::Scene;
use bytemuck::Zeroable;
use coact_joint_task::Act;
use coact_messages::{HandPoints, PartnerError, Plausible};
use coact_period::cycles;
use coact_person::{Activity, ActivityPhase, FINGERS, HandModel, Holder, PartsView, Policy, RobotHandView};
use coact_stage_state::Slot;
use glam::{DQuat, DVec3};

/// Cycles from one hand that is told to the next, at about 60 Hz.
const FRAME: u64 = 17;
const TOP: f64 = -1.31;
const SIDE: f64 = -0.17;

/// A person whose hand a test moves, and the parts.
struct Table {
    scene: Scene,
    model: HandModel,
    /// Middle between the finger tips (m), pitch (rad), aperture (m).
    hand: (DVec3, f64, f64),
    /// What the index finger points at instead, m.
    points_at: Option<DVec3>,
}

impl Table {
    fn new() -> Self {
        let scene = Scene::new(Policy::Live, 1);
        let model = HandModel::new(&scene.task.scene);
        let hand = (model.centre(&model.rest()), -0.35, 0.03);
        Self { scene, model, hand, points_at: None }
    }

    fn part(&self, kind: &str) -> usize {
        self.scene.task.parts.iter().position(|part| self.scene.task.kinds[part.kind].name == kind).unwrap()
    }

    fn centre(&self, part: usize) -> DVec3 {
        PartsView::new(&self.scene.parts).centre(part, &self.scene.task)
    }

    fn closed_on(&self, part: usize) -> f64 {
        self.scene.task.kinds[self.scene.parts[part].kind as usize].width + FINGERS
    }

    fn is(&self, part: usize, holder: Holder) -> bool {
        PartsView::new(&self.scene.parts).is(part, holder)
    }

    /// One cycle; the parts follow the hand as in the world.
    fn step(&mut self, told: bool) {
        self.scene.tick += 1;
        if told && self.scene.tick.is_multiple_of(FRAME) {
            let points = match self.points_at {
                Some(place) => self.model.pointing(self.hand.0, place),
                None => self.model.reaching(self.hand.0, self.hand.1, self.hand.2),
            };
            let points = points.map(|point| point.into());
            let mut message = HandPoints::zeroed();
            message.position = points;
            assert_eq!(message.check(), Ok(()));
            self.scene.person.show_hand(&mut self.scene.state, self.scene.tick, &points);
        }
        self.scene.step();
    }

    fn stay(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.step(true));
    }

    /// A movement of minimum jerk to there, in so many cycles.
    fn go(&mut self, to: (DVec3, f64, f64), ticks: u64) {
        let from = self.hand;
        for step in 1..=ticks {
            let t = step as f64 / ticks as f64;
            let along = t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
            let mix = |from: f64, to: f64| from + along * (to - from);
            self.hand = (from.0.lerp(to.0, along), mix(from.1, to.1), mix(from.2, to.2));
            self.step(true);
        }
    }

    /// Opens, goes there and closes.
    fn grasp(&mut self, part: usize, pitch: f64) {
        let (centre, closed) = (self.centre(part), self.closed_on(part));
        self.go((centre, pitch, closed + 0.03), 500);
        self.go((centre, pitch, closed), 150);
        self.stay(60);
    }
}

#[test]
fn fingers_that_close_on_a_part_have_it_and_the_action_began_when_the_hand_set_out() {
    let mut table = Table::new();
    table.stay(400);
    assert_eq!((table.scene.state.phase(), table.scene.state.actions), (ActivityPhase::Rest, 0));
    let wheel = table.part("wheel");
    let set_out = table.scene.tick;
    table.grasp(wheel, TOP);
    assert_eq!(table.scene.state.held, Slot::of(wheel));
    assert!(table.is(wheel, Holder::Person) && table.scene.state.actions == 1);
    let (onset, grasped) = (table.scene.state.onset - set_out, table.scene.state.grasped - set_out);
    assert!((50..250).contains(&onset), "set out after {onset} ms");
    assert!((500..700).contains(&grasped), "grasped after {grasped} ms");
    let chain = &table.scene.task.chains[table.scene.state.chain.get().unwrap()];
    assert_eq!((chain.name.as_str(), table.scene.state.activity()), ("insert", Activity::Insert));
    assert_eq!(table.scene.state.error, PartnerError::None);
}

#[test]
fn pitch_tells_apart_what_place_and_plan_leave_open() {
    for (pitch, name) in [(TOP, "insert"), (SIDE, "hand over")] {
        let mut table = Table::new();
        table.stay(100);
        table.grasp(table.part("wheel"), pitch);
        let chain = &table.scene.task.chains[table.scene.state.chain.get().unwrap()];
        assert_eq!(chain.name, name);
    }
}

#[test]
fn a_part_whose_turn_has_not_come_is_a_mistake() {
    let mut table = Table::new();
    table.stay(100);
    table.grasp(table.part("column 2"), TOP);
    assert_eq!((table.scene.state.actions, table.scene.state.error), (1, PartnerError::Early));
}

#[test]
fn fingers_that_close_elsewhere_or_come_closed_have_nothing() {
    let mut table = Table::new();
    table.stay(100);
    let wheel = table.part("wheel");
    let (centre, closed) = (table.centre(wheel), table.closed_on(wheel));
    table.go((centre + DVec3::new(0.0, -0.08, 0.05), TOP, 0.12), 500);
    table.go((table.hand.0, TOP, 0.02), 200);
    table.go((centre, TOP, closed - 0.02), 300);
    table.stay(300);
    assert_eq!((table.scene.state.held, table.scene.state.actions), (Slot::EMPTY, 0));
}

#[test]
fn a_hand_that_closes_while_it_passes_a_part_has_nothing() {
    let mut table = Table::new();
    table.stay(100);
    let wheel = table.part("wheel");
    let (centre, closed) = (table.centre(wheel), table.closed_on(wheel));
    let aside = DVec3::new(0.0, 0.2, 0.0);
    table.go((centre - aside, TOP, closed + 0.04), 500);
    table.go((centre + aside, TOP, closed - 0.04), 400);
    table.stay(300);
    assert_eq!((table.scene.state.held, table.scene.state.actions), (Slot::EMPTY, 0));
}

#[test]
fn a_held_part_follows_the_hand_turns_to_its_socket_and_is_let_go_by_open_fingers() {
    let mut table = Table::new();
    table.stay(100);
    let wheel = table.part("wheel");
    table.grasp(wheel, TOP);
    let lifted = table.hand.0 + DVec3::new(0.0, 0.0, 0.2);
    let mut fastest: f64 = 0.0;
    let mut last = table.centre(wheel);
    for _ in 0..400 {
        table.go((table.hand.0 + (lifted - table.hand.0) * 0.02, TOP, table.hand.2), 1);
        fastest = fastest.max(table.centre(wheel).distance(last));
        last = table.centre(wheel);
    }
    assert!(table.centre(wheel).distance(table.hand.0) < 0.01 && fastest < 0.006, "{fastest} m in a tick");
    assert_eq!(table.scene.state.phase(), ActivityPhase::Carry);
    let goal = &table.scene.task.subgoals[0];
    let (socket, axis) = (DVec3::from(goal.socket), DVec3::from(goal.axis));
    let beside = socket + axis * 0.0125 + DVec3::new(0.006, -0.008, 0.01);
    table.go((beside, TOP, table.hand.2), 700);
    table.stay(800);
    assert_eq!(table.scene.state.phase(), ActivityPhase::AwaitSteadying);
    assert!(table.scene.state.waits_for().is_within_action());
    table.scene.robot.steadying_since = table.scene.tick;
    table.stay(20);
    assert_eq!(table.scene.state.phase(), ActivityPhase::Mount);
    let turn = DQuat::from_array(table.scene.parts[wheel].orientation);
    assert!((turn * DVec3::Z).angle_between(axis) < 0.02);
    let off = DVec3::from(table.scene.parts[wheel].position).distance(socket);
    assert!(off < 0.003, "guided to {off} m from its socket");
    table.go((beside, TOP, table.hand.2 + 0.03), 150);
    assert!(table.is(wheel, Holder::Nobody));
    assert_eq!((table.scene.state.held, table.scene.state.phase()), (Slot::EMPTY, ActivityPhase::Withdraw));
    table.go((table.model.centre(&table.model.rest()), -0.35, 0.03), 600);
    table.stay(300);
    assert_eq!((table.scene.state.phase(), table.scene.state.actions), (ActivityPhase::Rest, 1));
}

#[test]
fn a_part_of_the_robot_s_becomes_the_person_s_when_the_robot_lets_go() {
    let mut table = Table::new();
    table.stay(100);
    let nut = table.part("nut");
    table.scene.parts[0].state = Holder::Socket as u32;
    table.scene.parts[0].subgoal = 0;
    table.scene.parts[nut].state = Holder::Robot as u32;
    table.scene.parts[nut].position = table.scene.task.scene.handover;
    table.scene.robot = RobotHandView { held: Some(nut), giving_since: 1, ..RobotHandView::default() };
    table.grasp(nut, SIDE);
    assert_eq!(table.scene.state.phase(), ActivityPhase::AwaitRelease);
    assert_eq!((table.scene.state.activity(), table.scene.state.actions), (Activity::Receive, 1));
    assert_eq!(
        table.scene.task.subgoals[table.scene.state.subgoal.get().unwrap()].name,
        "nut on the person's side"
    );
    table.stay(500);
    assert!(DVec3::from(table.scene.state.force).length() > 3.0 && table.is(nut, Holder::Robot));
    table.scene.robot = RobotHandView::default();
    table.scene.parts[nut].state = Holder::Person as u32;
    table.go((table.hand.0 - DVec3::new(0.1, 0.0, 0.0), SIDE, table.hand.2), 400);
    assert_eq!((table.scene.state.held, table.scene.state.phase()), (Slot::of(nut), ActivityPhase::Carry));
    assert!(table.centre(nut).distance(table.hand.0) < 0.01);
}

#[test]
fn a_part_is_held_out_to_the_robot_and_left_to_it() {
    let mut table = Table::new();
    table.stay(100);
    let wheel = table.part("wheel");
    table.grasp(wheel, SIDE);
    let handover = DVec3::from(table.scene.task.scene.handover);
    table.go((handover, SIDE, table.hand.2), 800);
    table.stay(300);
    assert_eq!(table.scene.state.phase(), ActivityPhase::Give);
    table.scene.robot = RobotHandView { held: Some(wheel), ..RobotHandView::default() };
    table.scene.parts[wheel].state = Holder::Robot as u32;
    table.stay(200);
    assert_eq!(table.scene.state.phase(), ActivityPhase::Give);
    table.go((handover, SIDE, table.hand.2 + 0.03), 100);
    assert!(table.is(wheel, Holder::Robot) && table.scene.state.held == Slot::EMPTY);
}

#[test]
fn a_finger_that_points_asks_for_that_part_of_the_robot_s_once() {
    for kind in ["nut", "column 3", "top floor"] {
        let mut table = Table::new();
        table.stay(100);
        let (part, rest) = (table.part(kind), table.hand);
        table.go((DVec3::new(-0.85, 0.3, 1.08), 0.0, 0.05), 700);
        table.points_at = Some(table.centre(part));
        table.stay(900);
        assert_eq!(
            (table.scene.state.phase(), table.scene.state.actions),
            (ActivityPhase::Show, 1),
            "{kind}"
        );
        assert_eq!(
            (table.scene.state.part, table.scene.state.activity()),
            (Slot::of(part), Activity::Request)
        );
        let chain = &table.scene.task.chains[table.scene.state.chain.get().unwrap()];
        assert!(chain.pointing && table.scene.task.kinds[chain.kind].name == kind);
        table.points_at = None;
        table.go(rest, 700);
        table.stay(300);
        assert_eq!((table.scene.state.phase(), table.scene.state.actions), (ActivityPhase::Rest, 1));
    }
    let mut table = Table::new();
    table.stay(100);
    table.go((DVec3::new(-0.85, 0.3, 1.08), 0.0, 0.05), 700);
    table.points_at = Some(DVec3::new(-0.85, 1.5, 1.0));
    table.stay(900);
    assert_eq!(table.scene.state.actions, 0, "nothing lies there");
}

#[test]
fn an_open_hand_held_out_is_a_request_once() {
    let mut table = Table::new();
    table.stay(100);
    table.scene.parts[0].state = Holder::Socket as u32;
    table.scene.parts[0].subgoal = 0;
    let place = DVec3::from(table.scene.task.scene.handover) - DVec3::new(0.1, 0.0, 0.0);
    table.go((place, 0.0, 0.11), 700);
    table.stay(1000);
    assert_eq!((table.scene.state.phase(), table.scene.state.actions), (ActivityPhase::Show, 1));
    let chain = &table.scene.task.chains[table.scene.state.chain.get().unwrap()];
    assert!(matches!(chain.act, Act::Gesture(_)) && table.scene.state.activity() == Activity::Request);
    assert_eq!(table.scene.task.kinds[chain.kind].name, "nut");
    assert_eq!(table.scene.state.error, PartnerError::None);
    table.go((table.model.centre(&table.model.rest()), -0.35, 0.03), 700);
    table.stay(300);
    assert_eq!((table.scene.state.phase(), table.scene.state.actions), (ActivityPhase::Rest, 1));
}

#[test]
fn a_hand_of_which_nobody_tells_any_more_is_not_known_and_keeps_what_it_has() {
    let mut table = Table::new();
    assert!(table.scene.person.is_unknown(&table.scene.state, 0), "before it was shown at all");
    table.stay(100);
    let wheel = table.part("wheel");
    table.grasp(wheel, TOP);
    assert!(!table.scene.person.is_lost(&table.scene.state, table.scene.tick));
    let lifetime = cycles(HandPoints::LIFETIME);
    (0..lifetime + FRAME).for_each(|_| table.step(false));
    assert!(table.scene.person.is_lost(&table.scene.state, table.scene.tick));
    let place = table.scene.parts[wheel].position;
    (0..5_000).for_each(|_| table.step(false));
    assert_eq!((table.scene.state.held, table.scene.parts[wheel].position), (Slot::of(wheel), place));
    // It comes back elsewhere, still closed: it has the part, and loses it where it comes back open.
    table.hand.0.y += 0.3;
    table.stay(100);
    assert_eq!(table.scene.state.held, Slot::of(wheel));
    assert!(DVec3::from(table.scene.parts[wheel].position).distance(place.into()) > 0.25);
    let there = table.scene.parts[wheel].position;
    (0..5_000).for_each(|_| table.step(false));
    table.hand.0.y -= 0.3;
    table.hand.2 += 0.04;
    table.stay(100);
    assert!(table.is(wheel, Holder::Nobody) && table.scene.state.held == Slot::EMPTY);
    assert_eq!(table.scene.parts[wheel].position, there);
}

#[test]
fn the_hand_moves_without_steps_between_what_is_told() {
    let mut table = Table::new();
    table.stay(100);
    let to = table.hand.0 + DVec3::new(0.3, 0.1, 0.1);
    let mut last = table.scene.person.hand_centre(&table.scene.state);
    let mut most: f64 = 0.0;
    for _ in 0..300 {
        let ahead = table.hand.0 + (to - table.hand.0) * 0.01;
        table.go((ahead, -0.35, 0.03), 1);
        let now = table.scene.person.hand_centre(&table.scene.state);
        most = most.max(now.distance(last));
        last = now;
    }
    assert!(most < 0.004, "{most} m in a tick");
}
