//! A hand that is told from outside, in the world without dynamics if nothing else is said.

use super::fake_robot::FakeRobot;
use super::{Out, held_by, robot, task};
use crate::{Partner, World};
use bytemuck::zeroed_box;
use coact_messages::{HandPoints, KeypointName, PartnerPhase, PersonWait, WorldState};
use coact_period::cycles;
use coact_person::{FINGERS, HandModel, Holder};
use coact_pipeline::WorldMode;
use glam::DVec3;

/// Cycles from one hand that is told to the next.
const FRAME: u64 = 17;
const TOP: f64 = -1.31;

fn world() -> World {
    world_in(WorldMode::Kinematic)
}

fn world_in(mode: WorldMode) -> World {
    let partner = Partner::load("hand", &task(), 1).unwrap();
    let settings = super::settings(1, partner, mode);
    World::new(&task(), &robot(), settings).unwrap()
}

/// A world, a robot that does nothing, and a hand that a test moves.
struct Bench {
    world: World,
    out: Out,
    model: HandModel,
    tick: u64,
    hand: (DVec3, f64),
}

impl Bench {
    fn new() -> Self {
        Self::of(WorldMode::Kinematic)
    }

    fn of(mode: WorldMode) -> Self {
        let model = HandModel::new(&task().scene);
        let hand = (model.centre(&model.rest()), 0.03);
        Self { world: world_in(mode), out: Out::new(), model, tick: 0, hand }
    }

    fn step(&mut self, told: bool) {
        if told && self.tick.is_multiple_of(FRAME) {
            let points = self.model.reaching(self.hand.0, TOP, self.hand.1);
            self.world.show_hand(&points.map(|point| point.to_array()));
        }
        self.tick += 1;
        let Out { sample, truth, state } = &mut self.out;
        self.world.step(self.tick, None, sample, truth, state);
        truth.header.cycle = self.tick;
    }

    fn go(&mut self, to: (DVec3, f64), ticks: u64) {
        let from = self.hand;
        for step in 1..=ticks {
            let t = step as f64 / ticks as f64;
            let along = t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
            self.hand = (from.0.lerp(to.0, along), from.1 + along * (to.1 - from.1));
            self.step(true);
        }
    }

    /// The first wheel, in the hand.
    fn with_wheel() -> Self {
        Self::with_wheel_in(WorldMode::Kinematic)
    }

    fn with_wheel_in(mode: WorldMode) -> Self {
        let mut bench = Self::of(mode);
        let centre = bench.world.parts.view().centre(0, &bench.world.task);
        let width = bench.world.task.kinds[bench.world.parts.kind(0)].width;
        bench.go(bench.hand, 300);
        bench.go((centre, width + FINGERS + 0.03), 600);
        bench.go((centre, width + FINGERS), 150);
        bench.go(bench.hand, 60);
        assert_eq!(held_by(&bench.world, Holder::Person), [0]);
        bench
    }

    fn sees_hand(&self) -> bool {
        self.tick - self.out.sample.hands[0].captured_cycle < 50
    }
}

#[test]
fn a_part_is_grasped_carried_and_mounted_where_the_fingers_open() {
    let mut bench = Bench::with_wheel();
    assert_eq!((bench.out.truth.actions, bench.out.truth.held), (1, [0, 1]));
    assert_eq!(bench.out.truth.phase, PartnerPhase::Transport as u32);
    let goal = bench.world.task.subgoals[bench.out.truth.subgoal as usize].clone();
    let place = DVec3::from(goal.socket) + 0.0125 * DVec3::from(goal.axis);
    bench.go((place, bench.hand.1), 900);
    bench.go(bench.hand, 600);
    assert_eq!(bench.out.truth.phase, PartnerPhase::Act as u32);
    assert_eq!(bench.out.truth.person_wait(), PersonWait::Steadying);
    assert_eq!(bench.out.truth.achieved, 0);
    bench.go((place, bench.hand.1 + 0.03), 150);
    bench.go(bench.hand, 30);
    assert!(bench.world.parts.is(0, Holder::Socket) && bench.out.truth.achieved.count_ones() == 1);
    assert_eq!(bench.out.truth.phase, PartnerPhase::Withdraw as u32);
}

#[test]
fn a_part_that_is_let_go_elsewhere_lies_there() {
    let mut bench = Bench::with_wheel();
    let above = bench.hand.0 + DVec3::new(0.0, -0.1, 0.15);
    bench.go((above, bench.hand.1), 600);
    bench.go((above, bench.hand.1 + 0.03), 200);
    bench.go(bench.hand, 30);
    assert!(bench.world.parts.is(0, Holder::Nobody));
    let at = bench.world.parts.position(0);
    assert_eq!(at.z, bench.world.task.scene.table_height);
    assert!(at.truncate().distance(above.truncate()) < 0.01);
}

#[test]
fn a_part_that_meets_the_robots_fingers_stays_behind_and_moves_no_joint_far() {
    let mut bench = Bench::with_wheel_in(WorldMode::Physics);
    let joints = |bench: &Bench| bench.out.state.position;
    let (before, palm) = (joints(&bench), bench.world.hand.palm(&joints(&bench)).grasp_point);
    let wheel = |bench: &Bench| bench.world.parts.view().centre(0, &bench.world.task);
    let on_the_way = wheel(&bench).distance(bench.hand.0);
    let (mut behind, mut pushed) = (0.0_f64, 0.0_f64);
    let (from, over) = (bench.hand.0, bench.hand.0.with_z(palm.z));
    let through = palm + 0.15 * (palm - over).normalize();
    for (from, to) in [(from, over), (over, through)] {
        for part in 1..=10 {
            bench.go((from.lerp(to, 0.1 * f64::from(part)), bench.hand.1), 100);
            behind = behind.max(wheel(&bench).distance(bench.hand.0) - on_the_way);
            let now = joints(&bench);
            let moved = now.iter().zip(&before).take(7).map(|(now, then)| (now - then).abs());
            pushed = moved.fold(pushed, f64::max);
        }
    }
    assert!(behind > 0.02, "the wheel was never more than {behind} m behind: it met nothing");
    // A hand three times as strong pushes twice as far.
    assert!(pushed < 0.001, "a joint was pushed aside by {pushed} rad");
}

#[test]
fn the_tracker_sees_the_hand_while_it_is_told_and_not_for_longer() {
    let mut bench = Bench::new();
    (0..500).for_each(|_| bench.step(false));
    assert_eq!((bench.out.sample.hands[0].captured_cycle, bench.out.truth.arms[0]), (0, [[0.0; 3]; 4]));
    bench.go(bench.hand, 1_000);
    assert!(bench.sees_hand());
    let shown = bench.out.sample.hands[0].keypoints[KeypointName::Wrist as usize].position;
    let told = bench.model.reaching(bench.hand.0, TOP, bench.hand.1)[KeypointName::Wrist as usize];
    assert!(DVec3::from(shown).distance(told) < 0.015);
    let (stalled, lifetime) = (bench.tick, cycles(HandPoints::LIFETIME));
    (0..1_000).for_each(|_| bench.step(false));
    // The last place may have been told a frame before, and the tracker's frame be one of its own later.
    let last = bench.out.sample.hands[0].captured_cycle;
    assert!((stalled..=stalled + lifetime + FRAME).contains(&last), "last seen {} ms after", last - stalled);
    assert_eq!(bench.out.truth.arms[0], [[0.0; 3]; 4]);
    bench.go(bench.hand, 200);
    assert!(bench.sees_hand());
}

#[test]
fn a_killed_world_goes_on_with_the_hand_and_what_it_has() {
    let mut bench = Bench::with_wheel();
    let above = bench.hand.0 + DVec3::new(0.0, 0.0, 0.15);
    bench.go((above, bench.hand.1), 300);
    let mut state: Box<WorldState> = zeroed_box();
    state.clone_from(&bench.out.state);
    let mut other = world();
    other.resume(&state).unwrap();
    let (mut one, mut two) = (Out::new(), Out::new());
    for tick in bench.tick + 1..bench.tick + 400 {
        if tick % FRAME == 0 {
            let points = bench.model.reaching(above, TOP, bench.hand.1).map(|point| point.to_array());
            bench.world.show_hand(&points);
            other.show_hand(&points);
        }
        bench.world.step(tick, None, &mut one.sample, &mut one.truth, &mut one.state);
        other.step(tick, None, &mut two.sample, &mut two.truth, &mut two.state);
        assert_eq!(bytemuck::bytes_of(&*one.state), bytemuck::bytes_of(&*two.state), "tick {tick}");
    }
    assert_eq!(held_by(&other, Holder::Person), [0]);
}

#[test]
fn hands_of_all_sorts_leave_a_world_that_can_go_on() {
    let (mut world, mut robot, mut out) = (world(), FakeRobot::new(), Out::new());
    let model = HandModel::new(&task().scene);
    for tick in 1..6_000 {
        let at = |salt: u64| ((tick / 30 * 7919 + salt * 104_729) % 1000) as f64 / 1000.0;
        if tick % 5 == 0 {
            let place = DVec3::new(-1.1 + 0.6 * at(1), -0.4 + 0.9 * at(2), 0.85 + 0.4 * at(3));
            let points = model.reaching(place, -1.5 + 1.6 * at(4), 0.02 + 0.13 * at(tick % 3));
            world.show_hand(&points.map(|point| point.to_array()));
        }
        robot.step(tick, &mut world, &mut out);
        if tick % 50 == 0 {
            self::world().resume(&out.state).unwrap();
        }
    }
}

#[test]
fn nobody_moves_the_hand_of_another_partner() {
    let (mut world, mut other) = (super::world(3), super::world(3));
    let points = HandModel::new(&task().scene).reaching(DVec3::new(-0.9, 0.0, 1.0), TOP, 0.1);
    let (mut one, mut two) = (Out::new(), Out::new());
    for tick in 1..3_000 {
        world.show_hand(&points.map(|point| point.to_array()));
        world.step(tick, None, &mut one.sample, &mut one.truth, &mut one.state);
        other.step(tick, None, &mut two.sample, &mut two.truth, &mut two.state);
    }
    assert_eq!(bytemuck::bytes_of(&*one.state), bytemuck::bytes_of(&*two.state));
}
