//! A movement of the robot's hand, planned without an obstacle and past one that stands on its way.
//!
//! `cargo run -p coact-examples --example past_an_obstacle`

use coact_motion::{
    Clearance, CollisionModel, Goal, HandSpeedLimits, Mechanism, MinClearance, Obstacle, Plan, Problem,
    Scene, SegmentKind, Solid,
};
use coact_robot::{HandGoal, MotionState, Robot};
use nalgebra::{Isometry3, Point3};
use std::path::Path;

fn main() -> anyhow::Result<()> {
    let robot = Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../rt-config/robots/aros.toml"))?;
    let mechanism = Mechanism::of(&robot)?;
    // The links, with fingers that stand a little open: their bases at 1.2 rad.
    let collision_model =
        mechanism.collision_model(&|name| if name.ends_with("base") { 1.2 } else { 0.0 })?;

    let free = Scene::default();
    let direct = plan(&mechanism, &collision_model, &free)?;
    tell("nothing in the way", &direct);

    // A pillar where the hand was on its way, 60 cm high and 8 cm thick.
    let middle = hand(&robot, &direct, 0.4);
    let pillar = Solid::Cylinder { radius: 0.04, height: 0.6 };
    let pillar = Obstacle::new("pillar", pillar, &Isometry3::translation(middle.x, middle.y, 1.0));
    let scene = Scene { obstacles: vec![pillar], ..Scene::default() };
    let around = plan(&mechanism, &collision_model, &scene)?;
    tell("past a pillar", &around);

    // How near the whole arm comes to the pillar, and to itself, on the way.
    let clearance = Clearance {
        mechanism: &mechanism,
        collision_model: &collision_model,
        scene: &scene,
        segment: SegmentKind::Reach,
    };
    let postures = (0..=200).map(|step| around.at(around.duration() * f64::from(step) / 200.0));
    let distances = postures
        .filter_map(|states| clearance.nearest(&states.map(|state| state.position), 0.1))
        .map(|near| near.distance);
    println!("nearest to anything: {:.0} mm", 1e3 * distances.fold(0.1, f64::min));
    Ok(())
}

/// Plans a movement from the park posture to a part of 4 cm height, which is gripped from above.
fn plan(mechanism: &Mechanism, collision_model: &CollisionModel, scene: &Scene) -> anyhow::Result<Plan> {
    let part = Isometry3::translation(-0.55, 0.25, 0.9);
    let goal = HandGoal::grip(&part, 0.04, 0, 0.15, f64::NEG_INFINITY);
    let problem = Problem {
        mechanism,
        collision_model,
        scene,
        start: mechanism.park.map(MotionState::at_rest),
        leave: None,
        goal: Goal::Hand(vec![goal]),
        next_displacements: Vec::new(),
        insertion_depth: 0.0,
        min_clearance: MinClearance::default(),
        hand_speeds: HandSpeedLimits::default(),
    };
    // A refusal names what is in the way, or the limit that is met.
    Ok(problem.plan()?)
}

/// Where the fingers would close, at a fraction of the movement's time.
fn hand(robot: &Robot, plan: &Plan, fraction: f64) -> Point3<f64> {
    robot.grasp_point(&plan.at(fraction * plan.duration()).map(|state| state.position))
}

fn tell(what: &str, plan: &Plan) {
    let way = if plan.bounces { "through a bounce posture" } else { "directly" };
    println!("{what:20} {:.2} s, {way}, {} segments", plan.duration(), plan.segments.len());
}
