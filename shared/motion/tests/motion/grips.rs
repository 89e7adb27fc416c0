//! Which grip is chosen, by what stands around the part and by where it goes next.
#![allow(clippy::unwrap_used)]

use coact_motion::{Goal, Mechanism, Obstacle, Problem, Scene, Solid};
use coact_robot::{Graspable, Grip, GripKind, GripSide, Grips, HandGoal, MotionState, NextUse, Robot};
use nalgebra::{Isometry3, Vector3};
use std::sync::LazyLock;

static AROS: LazyLock<(Robot, Mechanism)> = LazyLock::new(|| {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let robot = Robot::load(&root.join("../../rt-config/robots/aros.toml")).unwrap();
    let mechanism = Mechanism::of(&robot).unwrap();
    (robot, mechanism)
});

const HEIGHT: f64 = 0.12;

fn column() -> Isometry3<f64> {
    Isometry3::translation(-0.45, 0.5, 0.9)
}

/// The grip with which the column is taken, and its goal; none when it cannot be taken.
fn chosen(
    place: &Isometry3<f64>,
    around: Vec<Obstacle>,
    next_displacements: Vec<Isometry3<f64>>,
) -> Option<(Grip, HandGoal)> {
    let (robot, mechanism) = &*AROS;
    let grips = Grips::of(&robot.hand, Graspable::round(0.055, HEIGHT), NextUse::Anything);
    let joints = &robot.hand.joints;
    let angle =
        |name: &str| joints.iter().position(|joint| joint.name == name).map_or(0.0, |at| grips.open[at]);
    let collision_model = mechanism.collision_model(&angle).unwrap();
    let mut scene = Scene { obstacles: around, ..Scene::default() };
    let solid = Solid::Cylinder { radius: 0.0275, height: HEIGHT };
    scene.obstacles.push(Obstacle::new(
        "column",
        solid,
        &(place * Isometry3::translation(0.0, 0.0, 0.5 * HEIGHT)),
    ));
    let offers = grips.goals(place, 0.15, f64::NEG_INFINITY);
    let goal = Goal::Hand(offers.iter().map(|(_, goal)| *goal).collect());
    let start = robot.park.map(MotionState::at_rest);
    let plan =
        Problem { next_displacements, ..Problem::new(mechanism, &collision_model, &scene, start, goal) }
            .plan()
            .ok()?;
    let (index, goal) = offers[plan.target?.goal];
    Some((grips.all[index], goal))
}

fn side(around: Vec<Obstacle>, next_displacements: Vec<Isometry3<f64>>) -> GripSide {
    chosen(&column(), around, next_displacements).unwrap().0.side
}

/// A board over something that stands there.
fn roof(place: &Isometry3<f64>) -> Vec<Obstacle> {
    let at = place * Isometry3::translation(0.0, 0.0, HEIGHT + 0.05);
    vec![Obstacle::new("roof", Solid::Box(Vector3::new(0.12, 0.12, 0.02)), &at)]
}

/// Walls on all sides of something that stands there, as high as it is.
fn walls(place: &Isometry3<f64>) -> Vec<Obstacle> {
    let wall = |x: f64, y: f64| {
        let size = Vector3::new(if x == 0.0 { 0.2 } else { 0.01 }, if y == 0.0 { 0.2 } else { 0.01 }, HEIGHT);
        let at = place * Isometry3::translation(x, y, 0.5 * HEIGHT - 0.05);
        Obstacle::new("wall", Solid::Box(size), &at)
    };
    vec![wall(0.1, 0.0), wall(-0.1, 0.0), wall(0.0, 0.1), wall(0.0, -0.1)]
}

#[test]
fn under_a_roof_it_is_taken_from_the_side_and_between_walls_from_above() {
    assert_eq!(side(roof(&column()), Vec::new()), GripSide::Beside);
    assert_eq!(side(walls(&column()), Vec::new()), GripSide::Above);
}

#[test]
fn beside_walls_it_is_taken_from_where_there_is_room() {
    let out = [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y()];
    let mut open = 0;
    for (side, out) in out.iter().enumerate() {
        let mut around = walls(&column());
        around.remove(side);
        around.extend(roof(&column()));
        let Some((grip, goal)) = chosen(&column(), around, Vec::new()) else { continue };
        assert_eq!(grip.side, GripSide::Beside);
        assert!(goal.approach.dot(out) < -0.7, "{} through the side {out}", goal.approach);
        open += 1;
    }
    assert!(open > 0, "no side is open to the arm");
}

#[test]
fn it_is_taken_as_its_next_place_asks_for() {
    let place = Isometry3::translation(-0.55, 0.35, 1.0);
    let displacements = vec![place * column().inverse()];
    // Put into something deep, or handed over below something.
    assert_eq!(side(walls(&place), displacements.clone()), GripSide::Above);
    assert_eq!(side(roof(&place), displacements), GripSide::Beside);
}

#[test]
fn what_is_near_is_taken_with_the_whole_hand_and_what_is_far_by_the_finger_ends() {
    let kind = |place| chosen(&place, Vec::new(), Vec::new()).unwrap().0.kind;
    assert_eq!(kind(Isometry3::translation(-0.45, 0.5, 1.3)), GripKind::WholeHand);
    assert_eq!(kind(Isometry3::translation(-0.6, 0.5, 0.8)), GripKind::Precision);
}
