//! A hand that is told from outside grasps, carries and lets go by its fingers alone, and what it did is found from that.
#![allow(clippy::unwrap_used)]

use bytemuck::Zeroable;
use coact_joint_task::{Act, Task};
use coact_messages::{HandPoints, NONE, PartState, PartnerError, Plausible};
use coact_period::cycles;
use coact_person::{
    Activity, ActivityPhase, FINGERS, Habits, HandModel, Holder, PartsView, Person, PersonState, Policy,
    RobotHandView, Surroundings,
};
use coact_random::RandomStreams;
use coact_stage_state::Slot;
use glam::{DQuat, DVec3};
use std::path::{Path, PathBuf};

/// Cycles from one hand that is told to the next, at about 60 Hz.
const FRAME: u64 = 17;
const TOP: f64 = -1.31;
const SIDE: f64 = -0.17;

fn config(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file)
}

fn task() -> Task {
    Task::load(&config("tasks/toy-vehicle.toml")).unwrap()
}

/// A person whose hand a test moves, and the parts.
struct Table {
    task: Task,
    parts: Vec<PartState>,
    robot: RobotHandView,
    model: HandModel,
    person: Person,
    state: PersonState,
    tick: u64,
    /// Middle between the finger tips (m), pitch (rad), aperture (m).
    hand: (DVec3, f64, f64),
    /// What the index finger points at instead, m.
    points_at: Option<DVec3>,
}

impl Table {
    fn new() -> Self {
        let task = task();
        let lying = |part: &coact_joint_task::Part| PartState {
            position: [part.at[0], part.at[1], task.scene.table_height],
            orientation: [0.0, 0.0, 0.0, 1.0],
            kind: part.kind as u32,
            subgoal: NONE,
            ..PartState::default()
        };
        let parts = task.parts.iter().map(lying).collect();
        let model = HandModel::new(&task.scene);
        let habits = Habits::load(&config("person.toml"), &task).unwrap();
        let person = Person::new(&task.scene, &habits, Policy::Live, RandomStreams::new(1), None);
        let mut state = PersonState::zeroed();
        person.start(0, &mut state);
        let hand = (model.centre(&model.rest()), -0.35, 0.03);
        let robot = RobotHandView::default();
        Self { task, parts, robot, model, person, state, tick: 0, hand, points_at: None }
    }

    fn part(&self, kind: &str) -> usize {
        self.task.parts.iter().position(|part| self.task.kinds[part.kind].name == kind).unwrap()
    }

    fn centre(&self, part: usize) -> DVec3 {
        PartsView::new(&self.parts).centre(part, &self.task)
    }

    fn closed_on(&self, part: usize) -> f64 {
        self.task.kinds[self.parts[part].kind as usize].width + FINGERS
    }

    fn is(&self, part: usize, holder: Holder) -> bool {
        PartsView::new(&self.parts).is(part, holder)
    }

    /// One cycle; the parts follow the hand as in the world.
    fn step(&mut self, told: bool) {
        self.tick += 1;
        if told && self.tick.is_multiple_of(FRAME) {
            let points = match self.points_at {
                Some(place) => self.model.pointing(self.hand.0, place),
                None => self.model.reaching(self.hand.0, self.hand.1, self.hand.2),
            };
            let points = points.map(|point| point.into());
            let mut message = HandPoints::zeroed();
            message.position = points;
            assert_eq!(message.check(), Ok(()));
            self.person.show_hand(&mut self.state, self.tick, &points);
        }
        let parts = self.parts.clone();
        let around = Surroundings {
            tick: self.tick,
            task: &self.task,
            parts: PartsView::new(&parts),
            robot: self.robot,
        };
        let done = self.person.advance(&mut self.state, &around);
        if let Some(part) = done.grasped {
            self.parts[part].state = Holder::Person as u32;
        }
        if let Some((part, position, turn)) = done.moved {
            self.parts[part].position = position.into();
            self.parts[part].orientation = turn.into();
        }
        if let Some(part) = done.released {
            let owner = if self.robot.held == Some(part) { Holder::Robot } else { Holder::Nobody };
            self.parts[part].state = owner as u32;
        }
        self.person.check(&self.state, &self.task, self.tick).unwrap();
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
    assert_eq!((table.state.phase(), table.state.actions), (ActivityPhase::Rest, 0));
    let wheel = table.part("wheel");
    let set_out = table.tick;
    table.grasp(wheel, TOP);
    assert_eq!(table.state.held, Slot::of(wheel));
    assert!(table.is(wheel, Holder::Person) && table.state.actions == 1);
    let (onset, grasped) = (table.state.onset - set_out, table.state.grasped - set_out);
    assert!((50..250).contains(&onset), "set out after {onset} ms");
    assert!((500..700).contains(&grasped), "grasped after {grasped} ms");
    let chain = &table.task.chains[table.state.chain.get().unwrap()];
    assert_eq!((chain.name.as_str(), table.state.activity()), ("insert", Activity::Insert));
    assert_eq!(table.state.error, PartnerError::None);
}

#[test]
fn pitch_tells_apart_what_place_and_plan_leave_open() {
    for (pitch, name) in [(TOP, "insert"), (SIDE, "hand over")] {
        let mut table = Table::new();
        table.stay(100);
        table.grasp(table.part("wheel"), pitch);
        let chain = &table.task.chains[table.state.chain.get().unwrap()];
        assert_eq!(chain.name, name);
    }
}

#[test]
fn a_part_whose_turn_has_not_come_is_a_mistake() {
    let mut table = Table::new();
    table.stay(100);
    table.grasp(table.part("column 2"), TOP);
    assert_eq!((table.state.actions, table.state.error), (1, PartnerError::Early));
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
    assert_eq!((table.state.held, table.state.actions), (Slot::EMPTY, 0));
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
    assert_eq!((table.state.held, table.state.actions), (Slot::EMPTY, 0));
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
    assert_eq!(table.state.phase(), ActivityPhase::Carry);
    let goal = &table.task.subgoals[0];
    let (socket, axis) = (DVec3::from(goal.socket), DVec3::from(goal.axis));
    let beside = socket + axis * 0.0125 + DVec3::new(0.006, -0.008, 0.01);
    table.go((beside, TOP, table.hand.2), 700);
    table.stay(800);
    assert_eq!(table.state.phase(), ActivityPhase::AwaitSteadying);
    assert!(table.state.waits_for().is_within_action());
    table.robot.steadying_since = table.tick;
    table.stay(20);
    assert_eq!(table.state.phase(), ActivityPhase::Mount);
    let turn = DQuat::from_array(table.parts[wheel].orientation);
    assert!((turn * DVec3::Z).angle_between(axis) < 0.02);
    let off = DVec3::from(table.parts[wheel].position).distance(socket);
    assert!(off < 0.003, "guided to {off} m from its socket");
    table.go((beside, TOP, table.hand.2 + 0.03), 150);
    assert!(table.is(wheel, Holder::Nobody));
    assert_eq!((table.state.held, table.state.phase()), (Slot::EMPTY, ActivityPhase::Withdraw));
    table.go((table.model.centre(&table.model.rest()), -0.35, 0.03), 600);
    table.stay(300);
    assert_eq!((table.state.phase(), table.state.actions), (ActivityPhase::Rest, 1));
}

#[test]
fn a_part_of_the_robot_s_becomes_the_person_s_when_the_robot_lets_go() {
    let mut table = Table::new();
    table.stay(100);
    let nut = table.part("nut");
    table.parts[0].state = Holder::Socket as u32;
    table.parts[0].subgoal = 0;
    table.parts[nut].state = Holder::Robot as u32;
    table.parts[nut].position = table.task.scene.handover;
    table.robot = RobotHandView { held: Some(nut), giving_since: 1, ..RobotHandView::default() };
    table.grasp(nut, SIDE);
    assert_eq!(table.state.phase(), ActivityPhase::AwaitRelease);
    assert_eq!((table.state.activity(), table.state.actions), (Activity::Receive, 1));
    assert_eq!(table.task.subgoals[table.state.subgoal.get().unwrap()].name, "nut on the person's side");
    table.stay(500);
    assert!(DVec3::from(table.state.force).length() > 3.0 && table.is(nut, Holder::Robot));
    table.robot = RobotHandView::default();
    table.parts[nut].state = Holder::Person as u32;
    table.go((table.hand.0 - DVec3::new(0.1, 0.0, 0.0), SIDE, table.hand.2), 400);
    assert_eq!((table.state.held, table.state.phase()), (Slot::of(nut), ActivityPhase::Carry));
    assert!(table.centre(nut).distance(table.hand.0) < 0.01);
}

#[test]
fn a_part_is_held_out_to_the_robot_and_left_to_it() {
    let mut table = Table::new();
    table.stay(100);
    let wheel = table.part("wheel");
    table.grasp(wheel, SIDE);
    let handover = DVec3::from(table.task.scene.handover);
    table.go((handover, SIDE, table.hand.2), 800);
    table.stay(300);
    assert_eq!(table.state.phase(), ActivityPhase::Give);
    table.robot = RobotHandView { held: Some(wheel), ..RobotHandView::default() };
    table.parts[wheel].state = Holder::Robot as u32;
    table.stay(200);
    assert_eq!(table.state.phase(), ActivityPhase::Give);
    table.go((handover, SIDE, table.hand.2 + 0.03), 100);
    assert!(table.is(wheel, Holder::Robot) && table.state.held == Slot::EMPTY);
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
        assert_eq!((table.state.phase(), table.state.actions), (ActivityPhase::Show, 1), "{kind}");
        assert_eq!((table.state.part, table.state.activity()), (Slot::of(part), Activity::Request));
        let chain = &table.task.chains[table.state.chain.get().unwrap()];
        assert!(chain.pointing && table.task.kinds[chain.kind].name == kind);
        table.points_at = None;
        table.go(rest, 700);
        table.stay(300);
        assert_eq!((table.state.phase(), table.state.actions), (ActivityPhase::Rest, 1));
    }
    let mut table = Table::new();
    table.stay(100);
    table.go((DVec3::new(-0.85, 0.3, 1.08), 0.0, 0.05), 700);
    table.points_at = Some(DVec3::new(-0.85, 1.5, 1.0));
    table.stay(900);
    assert_eq!(table.state.actions, 0, "nothing lies there");
}

#[test]
fn an_open_hand_held_out_is_a_request_once() {
    let mut table = Table::new();
    table.stay(100);
    table.parts[0].state = Holder::Socket as u32;
    table.parts[0].subgoal = 0;
    let place = DVec3::from(table.task.scene.handover) - DVec3::new(0.1, 0.0, 0.0);
    table.go((place, 0.0, 0.11), 700);
    table.stay(1000);
    assert_eq!((table.state.phase(), table.state.actions), (ActivityPhase::Show, 1));
    let chain = &table.task.chains[table.state.chain.get().unwrap()];
    assert!(matches!(chain.act, Act::Gesture(_)) && table.state.activity() == Activity::Request);
    assert_eq!(table.task.kinds[chain.kind].name, "nut");
    assert_eq!(table.state.error, PartnerError::None);
    table.go((table.model.centre(&table.model.rest()), -0.35, 0.03), 700);
    table.stay(300);
    assert_eq!((table.state.phase(), table.state.actions), (ActivityPhase::Rest, 1));
}

#[test]
fn a_hand_of_which_nobody_tells_any_more_is_not_known_and_keeps_what_it_has() {
    let mut table = Table::new();
    assert!(table.person.is_unknown(&table.state, 0), "before it was shown at all");
    table.stay(100);
    let wheel = table.part("wheel");
    table.grasp(wheel, TOP);
    assert!(!table.person.is_lost(&table.state, table.tick));
    let lifetime = cycles(HandPoints::LIFETIME);
    (0..lifetime + FRAME).for_each(|_| table.step(false));
    assert!(table.person.is_lost(&table.state, table.tick));
    let place = table.parts[wheel].position;
    (0..5_000).for_each(|_| table.step(false));
    assert_eq!((table.state.held, table.parts[wheel].position), (Slot::of(wheel), place));
    // It comes back elsewhere, still closed: it has the part, and loses it where it comes back open.
    table.hand.0.y += 0.3;
    table.stay(100);
    assert_eq!(table.state.held, Slot::of(wheel));
    assert!(DVec3::from(table.parts[wheel].position).distance(place.into()) > 0.25);
    let there = table.parts[wheel].position;
    (0..5_000).for_each(|_| table.step(false));
    table.hand.0.y -= 0.3;
    table.hand.2 += 0.04;
    table.stay(100);
    assert!(table.is(wheel, Holder::Nobody) && table.state.held == Slot::EMPTY);
    assert_eq!(table.parts[wheel].position, there);
}

#[test]
fn the_hand_moves_without_steps_between_what_is_told() {
    let mut table = Table::new();
    table.stay(100);
    let to = table.hand.0 + DVec3::new(0.3, 0.1, 0.1);
    let mut last = table.person.hand_centre(&table.state);
    let mut most: f64 = 0.0;
    for _ in 0..300 {
        let ahead = table.hand.0 + (to - table.hand.0) * 0.01;
        table.go((ahead, -0.35, 0.03), 1);
        let now = table.person.hand_centre(&table.state);
        most = most.max(now.distance(last));
        last = now;
    }
    assert!(most < 0.004, "{most} m in a tick");
}
