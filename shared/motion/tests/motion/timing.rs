//! Movements in time: hardly slower than their path allows, and never faster than hand and joints may be.
#![allow(clippy::unwrap_used)]

use coact_motion::{
    CollisionModel, Goal, HandPath, HandSpeedLimits, Mechanism, Plan, Problem, Scene, SegmentKind,
};
use coact_robot::{HandGoal, MotionState, Posture, Robot};
use nalgebra::Isometry3;
use proptest::prelude::*;
use std::sync::LazyLock;

static AROS: LazyLock<(Mechanism, CollisionModel)> = LazyLock::new(|| {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let robot = Robot::load(&root.join("../../rt-config/robots/aros.toml")).unwrap();
    let mechanism = Mechanism::of(&robot).unwrap();
    let collision_model = mechanism.with_fingers(&robot.hand, &robot.hand.posture(1.2)).unwrap();
    (mechanism, collision_model)
});

fn planned(goal: Goal, hand_speeds: HandSpeedLimits) -> Option<Plan> {
    let (mechanism, collision_model) = &*AROS;
    let start = mechanism.park.map(MotionState::at_rest);
    let scene = Scene::default();
    Problem { hand_speeds, ..Problem::new(mechanism, collision_model, &scene, start, goal) }.plan().ok()
}

fn grip(x: f64, y: f64, z: f64) -> Goal {
    let part = Isometry3::translation(x, y, z);
    Goal::Hand(vec![HandGoal::grip(&part, 0.04, 0, 0.15, f64::NEG_INFINITY)])
}

/// The hand's largest speed, m/s, in the whole movement and in its last `near` m.
fn hand_speeds(plan: &Plan, near: f64) -> [f64; 2] {
    let path = HandPath::of(&AROS.0, plan, 400);
    let step = plan.duration() / path.speed.len() as f64;
    let place = |posture: &Posture| AROS.0.arm.palm(posture) * AROS.0.grasp_point();
    let end = place(&plan.end());
    let is_near = |index: usize| {
        let there = place(&plan.at(index as f64 * step).map(|state| state.position));
        (there - end).norm() < near && index as f64 * step > 0.5 * plan.duration()
    };
    let of = |counts: &dyn Fn(usize) -> bool| {
        let speeds = path.speed.iter().enumerate().filter(|(index, _)| counts(*index));
        speeds.map(|(_, speed)| *speed).fold(0.0, f64::max)
    };
    [of(&|_| true), of(&is_near)]
}

/// The time-optimal movement of one joint from rest to rest: its speed is a trapezoid, or a triangle on a short way.
fn of_one_joint(way: f64, velocity: f64, acceleration: f64) -> f64 {
    let rise = velocity / acceleration;
    if way > velocity * rise { way / velocity + rise } else { 2.0 * (way / acceleration).sqrt() }
}

#[test]
fn the_shortest_time_of_one_joint_is_the_known_one() {
    let limits = AROS.0.limits()[0];
    for way in [0.02, 0.1, 0.4, 1.0] {
        let mut to = AROS.0.park;
        to[0] += way;
        let fast = HandSpeedLimits { free: 100.0, contact: 100.0 };
        let plan = planned(Goal::Posture(to), fast).unwrap();
        // A plan leaves a twentieth of the limits to peaks between its knots.
        let known = of_one_joint(way, 0.95 * limits.velocity, 0.95 * limits.acceleration);
        let ratio = plan.shortest / known;
        assert!((0.99..1.03).contains(&ratio), "{way} rad: {} s of {known} s", plan.shortest);
    }
}

#[test]
fn a_gentle_hand_takes_longer_and_goes_as_gently_as_it_is_told() {
    let speeds = [1.0, 0.5, 0.25].map(|free| HandSpeedLimits { free, contact: 0.25 * free });
    let plans = speeds.map(|speeds| planned(grip(-0.35, 0.6, 0.9), speeds).unwrap());
    for (plan, told) in plans.iter().zip(speeds) {
        let [most, near] = hand_speeds(plan, 0.005);
        assert!(near < 1.1 * told.contact, "{near} m/s of {told:?}");
        assert!(most < 1.02 * told.free, "{most} m/s of {told:?}");
        assert!(most > 0.7 * told.free, "{most} m/s of {told:?}");
    }
    let durations = plans.each_ref().map(Plan::duration);
    assert!(durations[0] < 0.9 * durations[1] && durations[1] < 0.7 * durations[2], "{durations:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_movement_takes_little_longer_than_its_path_allows(x in -0.75..-0.2, y in 0.2..0.7, z in 0.75..1.2) {
        let speeds = HandSpeedLimits::default();
        let plan = planned(grip(x, y, z), speeds);
        prop_assume!(plan.is_some());
        let plan = plan.unwrap();
        prop_assert_eq!(plan.broken(&AROS.0.limits()), None);
        let [most, near] = hand_speeds(&plan, 0.005);
        prop_assert!(most < 1.03 * speeds.free, "{} m/s", most);
        prop_assert!(near < 1.1 * speeds.contact, "{} m/s at its end", near);
        let ratio = plan.duration() / plan.shortest;
        prop_assert!((0.98..1.3).contains(&ratio), "{} s of {} s", plan.duration(), plan.shortest);
        prop_assert_eq!(plan.segments.last().map(|(kind, _)| *kind), Some(SegmentKind::Approach));
    }
}
