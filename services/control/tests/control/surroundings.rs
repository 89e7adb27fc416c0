//! The arm in motion answers what changes around it: the decision, the part, the person.
#![allow(clippy::unwrap_used)]

use crate::kinematic_world::{Holder, KinematicWorld};
use coact_joint_task::ActionType;
use coact_messages::{ARM_JOINTS, ArmSide, Command, JOINTS, MotionPhase, ROBOT};
use coact_motion::{Capsule, Mechanism, MovingCapsules};
use coact_period::{CYCLES_PER_SECOND, PERIOD_S};
use coact_robot::Limiter;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const NUT: &str = "nut on the robot's side";
const WHEEL: &str = "wheel on the robot's side";

/// Speed of the arm's joints together, rad/s.
fn speed(command: &Command) -> f64 {
    command.velocity[..7].iter().map(|velocity| velocity * velocity).sum::<f64>().sqrt()
}

/// Reaching for the nut, in the middle of the movement.
fn reaching() -> KinematicWorld {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(2.0, "under way", |world| speed(&world.command) > 0.5);
    world
}

fn nut(world: &KinematicWorld) -> usize {
    let kind = world.task.subgoals.iter().find(|goal| goal.name == NUT).unwrap().kind;
    world.parts.iter().rposition(|part| part.kind == kind && part.workspace == ROBOT).unwrap()
}

/// Where the links are.
struct Body {
    mechanism: Mechanism,
    capsules: MovingCapsules,
}

impl Body {
    fn of(world: &KinematicWorld) -> Self {
        let mechanism = Mechanism::of(&world.robot).unwrap();
        Self { capsules: MovingCapsules::of(&mechanism, &world.robot.hand).unwrap(), mechanism }
    }

    /// In a posture of all joints.
    fn links(&self, position: &[f64; JOINTS]) -> Vec<Capsule> {
        let (mut fingers, mut links) = (Vec::new(), Vec::new());
        self.capsules.close(&std::array::from_fn(|joint| position[ARM_JOINTS + joint]), &mut fingers);
        let posture = std::array::from_fn(|joint| position[joint]);
        self.capsules.place(&self.mechanism, &posture, &fingers, &mut links);
        links
    }
}

/// Distance of arm and hand from the person's hand, m, in a posture of all joints.
fn distance(world: &KinematicWorld, body: &Body, position: &[f64; JOINTS]) -> f64 {
    distance_to(&person_hand(world, ArmSide::Right), body, position)
}

fn distance_to(hand: &Capsule, body: &Body, position: &[f64; JOINTS]) -> f64 {
    body.links(position).iter().map(|link| link.distance(hand)).fold(f64::INFINITY, f64::min)
}

fn person_hand(world: &KinematicWorld, side: ArmSide) -> Capsule {
    let arm = &world.percept.arms[side as usize];
    let [start, end] = [arm.wrist, arm.fingertip].map(|point| Point3::from(point.position));
    Capsule { start, end, radius: 0.045 }
}

/// Puts somebody's hand beside the palm, this near to the robot, m, and returns how near it is.
fn hand_beside_palm(world: &mut KinematicWorld, body: &Body, near: f64) -> f64 {
    let (palm, aside) = (world.palm().translation.vector, world.palm().rotation * Vector3::y());
    let mut gaps = (0..300).map(|step| {
        world.fingers_at((palm + (0.3 - 1e-3 * f64::from(step)) * aside).into());
        distance(world, body, &world.command.position)
    });
    gaps.find(|gap| *gap < near).unwrap()
}

#[test]
fn another_decision_moves_the_arm_within_60_ms_and_without_a_stop() {
    let mut world = reaching();
    let begun = world.command.begun;
    world.decide(Some(world.action(ActionType::Request, WHEEL)));
    let mut slowest = f64::INFINITY;
    world.until(0.5, "the other movement", |world| {
        slowest = slowest.min(speed(&world.command));
        world.command.begun > begun
    });
    assert!(world.command.reaction <= 60, "{} ms", world.command.reaction);
    assert!(slowest > 0.2, "it stopped: {slowest} rad/s");
}

#[test]
fn a_part_that_is_moved_is_followed_in_motion() {
    let mut world = reaching();
    let part = nut(&world);
    world.parts[part].frame.translation.vector.x += 0.06;
    let mut slowest = f64::INFINITY;
    let start = world.tick;
    world.until(3.0, "taken where it lies now", |world| {
        if world.tick < start + 300 {
            slowest = slowest.min(speed(&world.command));
        }
        world.held().is_some()
    });
    assert!(slowest > 0.1, "it stopped: {slowest} rad/s");
    world.until(8.0, "mounted", |world| matches!(world.parts[part].holder, Holder::Socket(_)));
}

#[test]
fn the_arm_keeps_away_from_a_person_who_is_in_the_way_and_goes_on_when_the_way_is_free() {
    let mut world = reaching();
    let part = nut(&world);
    let body = Body::of(&world);
    let [x, y, z]: [f64; 3] = world.parts[part].frame.translation.vector.into();
    world.fingers_at([x, y, z + 0.06]);
    let mut nearest = f64::INFINITY;
    for _ in 0..40 {
        world.run(0.1);
        nearest = nearest.min(distance(&world, &body, &world.command.position));
    }
    assert!(nearest > 0.03, "{nearest} m from the person's hand");
    assert!(world.held().is_none());
    world.hand_at(world.task.scene.person_rest);
    world.until(6.0, "taken", |world| world.held().is_some());
}

#[test]
fn fingers_that_something_holds_open_keep_clear_where_they_are_not_where_they_are_told_to_be() {
    for (aside, ahead) in [(0.12, 0.0), (-0.12, 0.0), (0.0, 0.12), (0.0, -0.12)] {
        let mut world = reaching();
        world.held_open = 0.6;
        let body = Body::of(&world);
        let [x, y, z]: [f64; 3] = world.parts[nut(&world)].frame.translation.vector.into();
        world.fingers_at([x + aside, y + ahead, z + 0.06]);
        let mut nearest = f64::INFINITY;
        for _ in 0..400 {
            world.run(0.01);
            nearest = nearest.min(distance(&world, &body, &world.sample.joints.position));
        }
        assert!(nearest > 0.04, "{nearest} m from the person's hand");
    }
}

#[test]
fn the_hand_that_does_not_act_is_kept_clear_of_as_well() {
    let mut world = reaching();
    world.held_open = 0.6;
    let body = Body::of(&world);
    let [x, y, z]: [f64; 3] = world.parts[nut(&world)].frame.translation.vector.into();
    world.left_fingers_at([x - 0.12, y, z + 0.06]);
    let hand = person_hand(&world, ArmSide::Left);
    let mut nearest = f64::INFINITY;
    for _ in 0..400 {
        world.run(0.01);
        nearest = nearest.min(distance_to(&hand, &body, &world.sample.joints.position));
    }
    assert!(nearest > 0.04, "{nearest} m from the person's left hand");
    world.left_fingers_at([x - 0.6, y, z + 0.06]);
    world.until(8.0, "taken", |world| world.held().is_some());
}

#[test]
fn a_hand_that_comes_in_from_the_side_slows_the_arm_without_touching_it() {
    let mut world = reaching();
    let body = Body::of(&world);
    let goal = world.parts[nut(&world)].frame.translation.vector;
    let rest = Point3::from(world.task.scene.person_rest);
    let target = Point3::new(goal.x, goal.y, goal.z + 0.08);
    // At most 0.5 m/s: nobody can stand still for a hand that is faster than the arm can brake.
    let line = target - rest;
    let velocity = line.normalize() * 0.5;
    let steps = (line.norm() / 0.5 * CYCLES_PER_SECOND as f64) as u32;
    for step in 0..steps {
        let at = rest + velocity * (f64::from(step) * PERIOD_S);
        world.fingers_move(at.coords.into(), velocity.into());
        let before = world.command.position;
        world.step();
        let [before, now] = [before, world.command.position].map(|at| distance(&world, &body, &at));
        assert!(
            now > 0.02 || now > before - 2e-5,
            "it moves {} mm towards a hand {now} m away",
            1e3 * (before - now)
        );
    }
}

#[test]
fn the_hand_keeps_clear_of_the_one_that_brings_a_part_until_it_takes_the_part() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Request, WHEEL)));
    world.until(4.0, "held out", |world| world.phase() == MotionPhase::Dwell);
    let body = Body::of(&world);
    let [x, y, z] = world.task.scene.handover;
    let wheel = world.task.subgoals.iter().find(|goal| goal.name == WHEEL).unwrap().kind;
    let part = world.parts.iter().position(|part| part.kind == wheel).unwrap();
    world.parts[part].holder = Holder::Person;
    world.parts[part].frame.translation.vector = [x, y, z].into();
    // The hand beside it, in the middle of the way from where the robot holds its own out to where it waits.
    world.fingers_at([x + 0.07, y + 0.05, z + 0.07]);
    world.decide(Some(world.action(ActionType::Receive, WHEEL)));
    let mut nearest = f64::INFINITY;
    world.until(6.0, "ready", |world| {
        nearest = nearest.min(distance(world, &body, &world.command.position));

        world.phase() == MotionPhase::Dwell
            && world.command.action == world.action(ActionType::Receive, WHEEL)
    });
    assert!(nearest > 0.03, "{nearest} m from the hand that brings the wheel");
    world.until(3.0, "taken out of it", |world| world.held().is_some());
}

#[test]
fn the_arm_gets_away_from_a_hand_that_has_come_too_near_while_it_stood() {
    let mut world = KinematicWorld::new();
    world.run(0.1);
    let body = Body::of(&world);
    let gap = hand_beside_palm(&mut world, &body, 0.03);
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    let mut nearest = f64::INFINITY;
    world.until(6.0, "at the nut", |world| {
        nearest = nearest.min(distance(world, &body, &world.command.position));
        world.phase() == MotionPhase::Approach
    });
    assert!(nearest > gap - 0.005, "{nearest} m, from {gap} m");
}

#[test]
fn a_part_that_is_seen_a_little_below_the_table_is_taken_from_it() {
    let mut world = KinematicWorld::new();
    let part = nut(&world);
    world.parts[part].frame.translation.vector.z -= 0.003;
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(5.0, "taken", |world| world.held().is_some());
}

/// Cycles in which each joint of the arm alone could be stopped from where it is, the slowest of them.
fn stopping_time(world: &KinematicWorld) -> u64 {
    let limits = world.robot.limits();
    let joints = (0..ARM_JOINTS).map(|joint| {
        let Command { position, velocity, acceleration, .. } = &*world.command;
        let mut state = Limiter {
            position: position[joint],
            velocity: velocity[joint],
            acceleration: acceleration[joint],
        };
        let mut cycles = 0;
        while !state.is_at_rest() {
            state = state.brake(&limits[joint], PERIOD_S);
            cycles += 1;
        }
        cycles
    });
    joints.max().unwrap()
}

#[test]
fn without_perception_the_arm_stands_within_little_more_than_its_joints_need_and_goes_on_after() {
    let (mut own, mut along_path, mut stops) = (0, 0, 0);
    for start in [0.3, 0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 1.8] {
        let mut world = KinematicWorld::new();
        world.decide(Some(world.action(ActionType::Insert, NUT)));
        world.run(start);
        let stale = world.percept.clone();
        // The percept grows old; sample and frame do not.
        let age = |world: &KinematicWorld| world.tick - stale.header.cycle;
        while age(&world) <= 50 {
            world.sense();
            let (sample, frame) = (world.sample.clone(), world.frame.clone());
            world.step_with(Some(&sample), Some(&stale), Some(&frame));
        }
        if speed(&world.command) < 0.3 {
            continue;
        }
        let (needed, begin) = (stopping_time(&world), world.tick);
        while speed(&world.command) > 0.0 {
            world.sense();
            let (sample, frame) = (world.sample.clone(), world.frame.clone());
            world.step_with(Some(&sample), Some(&stale), Some(&frame));
        }
        (own, along_path, stops) = (own + needed, along_path + world.tick - begin, stops + 1);
        world.until(8.0, "goes on", |world| world.held().is_some());
    }
    assert!(stops >= 4, "{stops}");
    let ratio = along_path as f64 / own as f64;
    println!("{stops} stops: joints alone {} ms, along the path {} ms", own / stops, along_path / stops);
    assert!(ratio < 1.5, "along the path it takes {ratio} times as long as the joints alone");
}

#[test]
fn a_person_who_was_never_seen_may_be_anywhere_and_the_arm_stands() {
    for side in [0, 1] {
        let mut world = KinematicWorld::new();
        world.percept.arms[side].age = u64::MAX;
        let before = world.command.position;
        world.decide(Some(world.action(ActionType::Insert, NUT)));
        world.run(2.0);
        assert_eq!(world.command.position, before, "one arm is as much as both");
        world.percept.arms[side].age = 0;
        world.until(8.0, "taken", |world| world.held().is_some());
    }
}

#[test]
fn somebody_who_is_not_seen_any_more_is_where_she_can_have_gone() {
    let mut world = reaching();
    // Near the way to the nut, then out of sight.
    let goal = world.parts[nut(&world)].frame.translation.vector;
    world.fingers_at([goal.x - 0.35, goal.y, goal.z + 0.15]);
    for age in 0..3000u64 {
        let arm = &mut world.percept.arms[0];
        (arm.age, arm.tracked) = (age, u32::from(age <= 150));
        for point in [&mut arm.shoulder, &mut arm.elbow, &mut arm.wrist, &mut arm.fingertip] {
            point.age = age;
        }
        world.step();
    }
    assert_eq!(speed(&world.command), 0.0, "nobody knows where she is now");
    assert!(world.held().is_none());
    world.hand_at(world.task.scene.person_rest);
    (world.percept.arms[0].age, world.percept.arms[0].tracked) = (0, 1);
    world.until(8.0, "taken", |world| world.held().is_some());
}

#[test]
fn a_hidden_hand_is_not_farther_from_a_shoulder_that_is_seen_than_the_arm_is_long() {
    let mut world = reaching();
    world.task.scene.person_shoulder[0] -= 0.4;
    world.hand_at(world.task.scene.person_rest);
    let arm = &mut world.percept.arms[0];
    (arm.age, arm.tracked) = (5000, 0);
    for point in [&mut arm.elbow, &mut arm.wrist, &mut arm.fingertip] {
        point.age = 5000;
    }
    world.until(8.0, "the nut lies beyond her reach", |world| world.held().is_some());
}

/// Most speed of what is nearer than the protective separation (`contact_speed_mps` in safety.toml), m/s.
const CONTACT_SPEED: f64 = 0.25;

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, rng_seed: RngSeed::Fixed(18), failure_persistence: None, ..ProptestConfig::default() })]

    // A hand that wanders about the way to the nut and sets out hard: it may come near an arm that brakes still.
    #[test]
    fn the_arm_closes_no_faster_than_at_contact_speed_what_is_nearer_than_the_protective_separation(
        targets in prop::collection::vec((-0.25..0.25f64, -0.25..0.25f64, 0.02..0.3f64), 8),
        most in 0.1..1.0f64,
    ) {
        let mut world = reaching();
        let body = Body::of(&world);
        let goal = world.parts[nut(&world)].frame.translation.vector;
        let (mut at, mut velocity) = (Vector3::from(world.task.scene.person_rest), Vector3::zeros());
        for (x, y, z) in targets {
            let target = goal + Vector3::new(x, y, z);
            for _ in 0..400 {
                let wanted = 4.0 * (target - at);
                let wanted = wanted.cap_magnitude(most);
                velocity += (wanted - velocity).cap_magnitude(10.0 * PERIOD_S);
                at += velocity * PERIOD_S;
                world.fingers_move(at.into(), velocity.into());
                let before = world.command.position;
                world.step();
                let [before, now] = [before, world.command.position].map(|joints| distance(&world, &body, &joints));
                // Where the hand has run into the arm already, each way out leads past a part of it.
                prop_assert!(
                    !(0.005..0.04).contains(&now) || now > before - CONTACT_SPEED * PERIOD_S,
                    "it moves {} mm towards a hand {now} m away", 1e3 * (before - now)
                );
            }
        }
    }
}
