//! Movements of our robot: to the goal, within the limits, clear of everything, or refused with the reason.
#![allow(clippy::unwrap_used)]

use coact_motion::{
    Capsule, Clearance, CollisionModel, Counterpart, Goal, Mechanism, Obstacle, Plan, Problem, Refusal,
    Scene, SegmentKind, Solid,
};
use coact_robot::{HAND_JOINTS, HandGoal, MotionState, Posture, Robot};
use nalgebra::{Isometry3, Point3, Vector3};
use proptest::prelude::*;
use std::sync::LazyLock;

fn aros() -> Robot {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    Robot::load(&root.join("../../rt-config/robots/aros.toml")).unwrap()
}

static AROS: LazyLock<(Mechanism, CollisionModel)> = LazyLock::new(|| {
    let mechanism = Mechanism::of(&aros()).unwrap();
    let collision_model =
        mechanism.collision_model(&|name| if name.ends_with("base") { 1.2 } else { 0.0 }).unwrap();
    (mechanism, collision_model)
});

fn grip_at(x: f64, y: f64, z: f64) -> HandGoal {
    HandGoal::grip(&Isometry3::translation(x, y, z), 0.04, 0, 0.15, f64::NEG_INFINITY)
}

fn problem<'a>(scene: &'a Scene, start: [MotionState; 7], goal: HandGoal) -> Problem<'a> {
    let (mechanism, collision_model) = &*AROS;
    Problem::new(mechanism, collision_model, scene, start, Goal::Hand(vec![goal]))
}

fn parked() -> [MotionState; 7] {
    AROS.0.park.map(MotionState::at_rest)
}

fn grasp_point(posture: &Posture) -> Point3<f64> {
    AROS.0.arm.palm(posture) * AROS.0.grasp_point()
}

fn posture(plan: &Plan, fraction: f64) -> Posture {
    plan.at(fraction * plan.duration()).map(|state| state.position)
}

fn pillar(x: f64, y: f64) -> Scene {
    let solid = Solid::Cylinder { radius: 0.04, height: 0.6 };
    let pillar = Obstacle::new("pillar", solid, &Isometry3::translation(x, y, 1.0));
    Scene { obstacles: vec![pillar], ..Scene::default() }
}

#[test]
fn the_hand_comes_to_its_goal_from_the_side_it_was_told() {
    let (scene, goal) = (Scene::default(), grip_at(-0.4, 0.55, 0.8));
    let plan = problem(&scene, parked(), goal).plan().unwrap();
    assert!((grasp_point(&plan.end()) - goal.point).norm() < 1e-4);
    let approach = AROS.0.arm.palm(&plan.end()).rotation * Vector3::z();
    assert!(approach.angle(&goal.approach) < 1e-3);
    let mut kinds: Vec<_> = plan.segments.iter().map(|(kind, _)| *kind).collect();
    kinds.dedup();
    assert_eq!(kinds, [SegmentKind::Reach, SegmentKind::Approach]);
    assert_eq!(plan.broken(&AROS.0.limits()), None);
}

/// A wheel that came to the end of its axle 8 mm aside, and a nut that was 10 degrees askew there, were pressed against it.
#[test]
fn what_the_hand_puts_into_its_place_goes_in_straight() {
    let (scene, depth) = (Scene::default(), 0.05);
    for (x, y) in [(-0.6, 0.3), (-0.56, 0.24), (-0.45, 0.35), (-0.4, 0.55), (-0.3, 0.7)] {
        let goal = grip_at(x, y, 0.85);
        let problem = Problem { insertion_depth: depth, ..problem(&scene, parked(), goal) };
        let plan = problem.plan().unwrap();
        let axis = AROS.0.arm.palm(&plan.end()).inverse_transform_vector(&goal.along);
        for step in (0..=1000).rev() {
            let palm = AROS.0.arm.palm(&posture(&plan, f64::from(step) / 1000.0));
            let off = palm * AROS.0.grasp_point() - goal.point;
            let outside = -off.dot(&goal.along);
            if outside > depth {
                break;
            }
            let aside = (off + outside * goal.along).norm();
            let turned = (palm * axis).angle(&goal.along).to_degrees();
            assert!(
                aside < 0.004 && turned < 4.0,
                "{x}, {y}: {aside} m, {turned} degrees, {outside} m outside"
            );
        }
    }
}

#[test]
fn what_blocks_the_direct_movement_is_passed_at_the_required_clearance() {
    let goal = grip_at(-0.55, 0.25, 0.9);
    let free = problem(&Scene::default(), parked(), goal).plan().unwrap();
    let middle = grasp_point(&posture(&free, 0.4));
    let scene = pillar(middle.x, middle.y);
    let problem = problem(&scene, parked(), goal);
    let plan = problem.plan().unwrap();
    assert!(plan.bounces, "a direct movement cannot be clear");
    let clearance = Clearance {
        mechanism: problem.mechanism,
        collision_model: problem.collision_model,
        scene: &scene,
        segment: SegmentKind::Reach,
    };
    for step in 0..=500 {
        let near = clearance.nearest(&posture(&plan, f64::from(step) / 500.0), 0.02);
        let distance = near.map_or(0.02, |near| near.distance);
        assert!(distance > 0.002, "{distance} m at {step} of 500");
    }
}

#[test]
fn a_goal_in_the_table_is_refused_and_the_table_named() {
    let table = Solid::Box(Vector3::new(1.0, 1.2, 0.04));
    let table = Obstacle::new("table", table, &Isometry3::translation(-0.7, 0.3, 0.78));
    let scene = Scene { obstacles: vec![table], ..Scene::default() };
    let refusal = problem(&scene, parked(), grip_at(-0.4, 0.55, 0.7)).plan().unwrap_err();
    assert!(matches!(&refusal, Refusal::Blocked { other, .. } if other == "table"), "{refusal}");
}

#[test]
fn a_goal_beyond_the_arm_is_refused() {
    let refusal = problem(&Scene::default(), parked(), grip_at(-2.0, 0.5, 0.8)).plan().unwrap_err();
    assert!(matches!(refusal, Refusal::OutOfReach { .. }), "{refusal}");
}

/// Four bars close around the wrist: the hand does not fit through.
fn ring() -> Scene {
    let wrist = AROS.0.arm.frame(&AROS.0.park, 6) * Isometry3::translation(0.0, 0.0, 0.09);
    let bar = |x: f64, y: f64| {
        let solid = Solid::Box(Vector3::new(
            if x == 0.0 { 0.16 } else { 0.02 },
            if y == 0.0 { 0.16 } else { 0.02 },
            0.02,
        ));
        Obstacle::new("ring", solid, &(wrist * Isometry3::translation(x, y, 0.0)))
    };
    let obstacles = vec![bar(0.065, 0.0), bar(-0.065, 0.0), bar(0.0, 0.065), bar(0.0, -0.065)];
    Scene { obstacles, ..Scene::default() }
}

#[test]
fn a_hand_that_cannot_get_out_is_told_so_whatever_is_tried() {
    let refusal = problem(&ring(), parked(), grip_at(-0.4, 0.55, 0.8)).plan().unwrap_err();
    assert!(matches!(&refusal, Refusal::NoPath { other, .. } if other == "ring"), "{refusal}");
}

#[test]
fn a_start_inside_something_is_refused() {
    let hand = grasp_point(&AROS.0.park);
    let block = Obstacle::new(
        "block",
        Solid::Box(Vector3::repeat(0.2)),
        &Isometry3::from_parts(hand.coords.into(), Default::default()),
    );
    let scene = Scene { obstacles: vec![block], ..Scene::default() };
    let refusal = problem(&scene, parked(), grip_at(-0.4, 0.55, 0.8)).plan().unwrap_err();
    assert!(matches!(&refusal, Refusal::Start { other, .. } if other == "block"), "{refusal}");
}

#[test]
fn the_same_problem_gives_the_same_movement() {
    let scene = pillar(-0.3, 0.45);
    let plan = || problem(&scene, parked(), grip_at(-0.55, 0.25, 0.9)).plan();
    assert_eq!(plan(), plan());
}

/// Whether the hand can stand so, with nothing around.
fn can_stand(palm: &Isometry3<f64>) -> bool {
    let closed_form = AROS.0.closed_form.as_ref().unwrap();
    (0..72).any(|step| !closed_form.solve(palm, f64::from(step) * 0.0873, 0.0175).as_slice().is_empty())
}

#[test]
fn a_part_that_goes_on_is_gripped_so_that_the_hand_can_go_on() {
    let scene = Scene::default();
    let part = Isometry3::translation(-0.45, 0.5, 0.85);
    let grips = (0..12)
        .map(|side| {
            HandGoal::grip_from_side(&part, 0.04, f64::from(side) * std::f64::consts::FRAC_PI_6, 0.15)
        })
        .collect();
    let mut problem = problem(&scene, parked(), grip_at(0.0, 0.0, 0.0));
    problem.goal = Goal::Hand(grips);
    let palm = |plan: &Plan| AROS.0.arm.palm(&plan.target.unwrap().at);
    let comfortable = palm(&problem.plan().unwrap());
    let mut others = 0;
    for turn in 1..8 {
        let socket = Isometry3::translation(-0.7, 0.2, 1.0)
            * nalgebra::UnitQuaternion::from_axis_angle(
                &Vector3::z_axis(),
                std::f64::consts::FRAC_PI_4 * f64::from(turn),
            );
        let displacement = socket * part.inverse();
        problem.next_displacements = vec![displacement];
        let plan = problem.plan().unwrap();
        if !can_stand(&(displacement * comfortable)) && can_stand(&(displacement * palm(&plan))) {
            others += 1;
        }
        assert!(
            can_stand(&(displacement * palm(&plan))) || !can_stand(&(displacement * comfortable)),
            "turn {turn}"
        );
    }
    assert!(others > 0, "the comfortable grip could go on everywhere");
}

#[test]
fn what_follows_is_no_reason_to_refuse_a_grip() {
    let scene = Scene::default();
    let mut problem = problem(&scene, parked(), grip_at(-0.4, 0.55, 0.8));
    let target = problem.plan().unwrap().target;
    problem.next_displacements = vec![Isometry3::translation(0.0, 0.0, 50.0)];
    assert_eq!(problem.plan().unwrap().target, target);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_movement_goes_on_from_the_present_motion(fraction in 0.1..0.9, x in -0.6..-0.3, y in 0.3..0.7) {
        let scene = Scene::default();
        let first = problem(&scene, parked(), grip_at(-0.4, 0.55, 0.8)).plan().unwrap();
        let now = first.at(fraction * first.duration());
        match problem(&scene, now, grip_at(x, y, 0.85)).plan() {
            Ok(plan) => {
                for (begun, now) in plan.at(0.0).iter().zip(&now) {
                    prop_assert!((begun.position - now.position).abs() < 1e-9);
                    prop_assert!((begun.velocity - now.velocity).abs() < 1e-9);
                    prop_assert!((begun.acceleration - now.acceleration).abs() < 1e-6);
                }
                prop_assert_eq!(plan.broken(&AROS.0.limits()), None);
            }
            Err(refusal) => prop_assert!(matches!(refusal, Refusal::TooFast { .. }), "{}", refusal),
        }
    }

    #[test]
    fn distances_change_as_their_gradients_say(turn in prop::array::uniform7(-0.3..0.3)) {
        let (mechanism, collision_model) = &*AROS;
        let posture: Posture = std::array::from_fn(|joint| mechanism.park[joint] + turn[joint]);
        let hand = grasp_point(&posture);
        let sphere = Capsule { start: Point3::origin(), end: Point3::origin(), radius: 0.05 };
        let place = Isometry3::translation(hand.x + 0.15, hand.y, hand.z);
        let scene = Scene { obstacles: vec![Obstacle::new("sphere", Solid::Capsule(sphere), &place)], ..Scene::default() };
        let clearance = Clearance { mechanism, collision_model, scene: &scene, segment: SegmentKind::Reach };
        let mut found = Vec::new();
        clearance.near(&posture, 0.3, &mut found);
        for near in found.iter().filter(|near| near.distance > 0.01) {
            for joint in 0..7 {
                let h = 2e-3;
                let distance = |sign: f64| {
                    let mut moved = posture;
                    moved[joint] += sign * h;
                    let mut again = Vec::new();
                    clearance.near(&moved, 0.5, &mut again);
                    again.iter().find(|other| other.link == near.link && other.other == near.other).unwrap().distance
                };
                // Where another edge or face becomes the nearest one there is no gradient to be compared with.
                let (before, after) = (near.distance - distance(-1.0), distance(1.0) - near.distance);
                if (before - after).abs() < 0.01 * h {
                    let gradient = (before + after) / (2.0 * h);
                    prop_assert!((gradient - near.gradient[joint]).abs() < 0.02, "{} against {}", gradient, near.gradient[joint]);
                }
            }
        }
    }

    /// Against the distance of a box from a sphere, which is known exactly. (The geometry library in single precision
    /// was off by 4 mm here.)
    #[test]
    fn distances_are_true(turn in prop::array::uniform7(-0.3..0.3), off in prop::array::uniform3(-0.2..0.2f64)) {
        let (mechanism, collision_model) = &*AROS;
        let posture: Posture = std::array::from_fn(|joint| mechanism.park[joint] + turn[joint]);
        let centre = grasp_point(&posture) + Vector3::from(off);
        let sphere = Solid::Capsule(Capsule { start: centre, end: centre, radius: 0.05 });
        let scene = Scene { obstacles: vec![Obstacle::new("sphere", sphere, &Isometry3::identity())], ..Scene::default() };
        let mut found = Vec::new();
        Clearance { mechanism, collision_model, scene: &scene, segment: SegmentKind::Reach }.near(&posture, 0.5, &mut found);
        for near in found.iter().filter(|near| near.other == Counterpart::Obstacle(0) && near.distance > 0.0) {
            let link = &collision_model.links()[near.link];
            let Solid::Box(size) = link.solid else { continue };
            let place = mechanism.arm.frame(&posture, link.carriers - 1) * link.place;
            let beyond = ((place.inverse() * centre).coords.abs() - 0.5 * size).map(|length| length.max(0.0));
            prop_assert!((near.distance - (beyond.norm() - 0.05)).abs() < 1e-4);
        }
    }
}

#[test]
fn what_only_passing_fingers_would_touch_counts_on_the_reach_alone() {
    let (robot, mechanism) = (aros(), &AROS.0);
    let [closed, between, open] = [1.5, 1.05, 0.6].map(|base| robot.hand.posture(base));
    let tip = |fingers: &[f64; HAND_JOINTS]| {
        let collision_model = mechanism.with_fingers(&robot.hand, fingers).unwrap();
        let of_tip = collision_model.links().iter().position(|link| link.name == "finger_3_distal").unwrap();
        collision_model.bounding_capsules(mechanism, &mechanism.park)[of_tip].end
    };
    let collision_model = mechanism.with_moving_fingers(&robot.hand, &[closed, open]).unwrap();
    let near = |fingers: &[f64; HAND_JOINTS], segment: SegmentKind| {
        let sphere = Capsule { start: tip(fingers), end: tip(fingers), radius: 0.005 };
        let thing = Obstacle::new("thing", Solid::Capsule(sphere), &Isometry3::identity());
        let scene = Scene { obstacles: vec![thing], ..Scene::default() };
        Clearance { mechanism, collision_model: &collision_model, scene: &scene, segment }
            .nearest(&mechanism.park, 0.015)
            .is_some()
    };
    let segments = [SegmentKind::Leave, SegmentKind::Reach, SegmentKind::Approach];
    assert_eq!(segments.map(|segment| near(&closed, segment)), [true, true, false]);
    assert_eq!(segments.map(|segment| near(&between, segment)), [false, true, false]);
    assert_eq!(segments.map(|segment| near(&open, segment)), [false, true, true]);
}

/// A hand that had let a part go near the end of its reach could not rise straight by 15 cm, and one that had received a part at the limit of a
/// joint not at all: each was refused every movement, and stood for ever.
#[test]
fn a_hand_that_cannot_leave_as_far_as_it_is_asked_to_leaves_less_far_or_not_straight() {
    let scene = Scene::default();
    let there = problem(&scene, parked(), grip_at(-0.4, 0.55, 0.8)).plan().unwrap().end();
    let start = there.map(MotionState::at_rest);
    let leaving_in = |scene: &Scene, distance: f64| {
        let leave = Some((Vector3::z(), distance));
        Problem { leave, goal: Goal::Posture(AROS.0.park), ..problem(scene, start, grip_at(-0.4, 0.55, 0.8)) }
            .plan()
    };
    let leaving = |distance| leaving_in(&scene, distance);
    let farthest = (1..40).map(|step| 0.05 * f64::from(step)).find(|distance| {
        let left = leaving(*distance).unwrap();
        let end = left.segments[0].1;
        let risen = grasp_point(&left.at(end).map(|state| state.position)).z - grasp_point(&there).z;
        risen < 0.9 * distance
    });
    assert!(farthest.is_some_and(|distance| distance < 1.5), "{farthest:?}");
    let plan = leaving(9.0).unwrap();
    assert!(matches!(plan.segments[..], [(SegmentKind::Reach, _)]), "{:?}", plan.segments);
    // What the hand may touch only while it leaves keeps it.
    let at = AROS.0.arm.palm(&there);
    let ball = Capsule { start: Point3::origin(), end: Point3::origin(), radius: 0.02 };
    let part = Obstacle::new("part", Solid::Capsule(ball), &at);
    let around = Scene { obstacles: vec![part], ..Scene::default() }.touching(&["part"]);
    assert!(leaving_in(&around, 0.1).is_ok() && leaving_in(&around, 9.0).is_err());
}
