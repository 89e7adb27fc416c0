//! Reaches from anywhere to anywhere, that any arm can make.

use crate::{Case, Setting};
use coact_motion::{Clearance, Goal, Obstacle, Scene, SegmentKind, Solid};
use coact_robot::{HandGoal, MotionState, Posture};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;

/// Fraction of the joint ranges, about their middles, from which starts and goals of reaches are drawn. Chosen by hand:
/// postures that people would call comfortable, away from the limits.
const RANGE: f64 = 0.6;
/// Shortest reach, m: nearer goals are no test. Chosen by hand.
const SHORTEST: f64 = 0.25;
/// Clearance of a posture from the robot itself that is drawn, m. Chosen by hand: twice what the planner keeps.
const CLEAR: f64 = 0.02;
/// Radius and height of obstacles, m. Chosen by hand: a bottle, and a post that nothing passes over.
pub(super) const SMALL: (f64, f64) = (0.03, 0.16);
pub(super) const TALL: (f64, f64) = (0.04, 0.60);
/// How far an obstacle's axis stands aside of the line from start to goal at most, along x and along y, m. Chosen by hand:
/// the hand cannot pass on that line.
const ASIDE: f64 = 0.05;
/// How far an obstacle's axis stands from the goal at least, m: nearer ones leave the hand no room.
const FROM_GOAL: f64 = 0.12;
/// The inside of a shelf: height (between these), then depth, width, and thickness of its boards, m. Chosen by hand: a
/// little more than the hand needs.
const SHELF_HEIGHT: std::ops::Range<f64> = 0.22..0.30;
const SHELF: [f64; 3] = [0.22, 0.40, 0.02];
/// How level an approach must be that is made level to go into a shelf: the length of its level part. Chosen by hand.
const LEVEL: f64 = 0.8;
/// Distance from which the hand goes straight into a shelf, m: as before a grasp.
const BEFORE: f64 = 0.15;

/// From anywhere to anywhere, with nothing around.
pub(super) fn free_reach(setting: &Setting, random: &mut Pcg64) -> Case {
    loop {
        let (from, to) = (comfortable(setting, random), comfortable(setting, random));
        let goal = hand_at(setting, &to);
        let start = setting.mechanism.arm.palm(&from) * setting.mechanism.grasp_point();
        if (start - goal.point).norm() > SHORTEST {
            return Case {
                collision_model: setting.open.clone(),
                scene: Scene::default(),
                start: from.map(MotionState::at_rest),
                leave: None,
                goal: Goal::Hand(vec![goal]),
                insertion_depth: 0.0,
            };
        }
    }
}

/// A reach past upright cylinders that stand between start and goal.
pub(super) fn past(setting: &Setting, random: &mut Pcg64, sizes: &[(f64, f64)]) -> Option<Case> {
    let mut case = free_reach(setting, random);
    let Goal::Hand(goals) = &case.goal else { return None };
    let grasp = |posture: &Posture| setting.mechanism.arm.palm(posture) * setting.mechanism.grasp_point();
    let from = grasp(&case.start.map(|state| state.position));
    let line = goals[0].point - from;
    for (index, &(radius, height)) in sizes.iter().enumerate() {
        let fraction = (index as f64 + random.random_range(0.8..1.2)) / (sizes.len() as f64 + 1.0);
        let aside = Vector3::new(random.random_range(-ASIDE..ASIDE), random.random_range(-ASIDE..ASIDE), 0.0);
        let centre = from + line * fraction + aside;
        let place = Isometry3::translation(centre.x, centre.y, centre.z);
        let solid = Solid::Cylinder { radius, height };
        case.scene.obstacles.push(Obstacle::new(format!("obstacle {}", index + 1), solid, &place));
    }
    let room = |obstacle: &Obstacle| {
        let apart = obstacle.place.translation.vector - goals[0].point.coords;
        apart.x.hypot(apart.y) > FROM_GOAL
    };
    let is_sound = case.starts_clear(&setting.mechanism) && case.scene.obstacles.iter().all(room);
    is_sound.then_some(case)
}

/// A reach into a shelf: two boards, a back and two sides.
pub(super) fn shelf(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    let mut case = free_reach(setting, random);
    let Goal::Hand(goals) = &mut case.goal else { return None };
    let goal = &mut goals[0];
    let flat = Vector3::new(goal.approach.x, goal.approach.y, 0.0);
    if flat.norm() < LEVEL {
        return None;
    }
    goal.approach = flat.normalize();
    goal.along = goal.approach;
    goal.rolls = 0;
    goal.back = BEFORE;
    let turn = UnitQuaternion::rotation_between(&Vector3::x(), &goal.approach)?;
    let frame = Isometry3::from_parts(Translation3::from(goal.point.coords), turn);
    let room = random.random_range(SHELF_HEIGHT);
    let [depth, wide, thick] = SHELF;
    let mut board = |name: &str, size: [f64; 3], at: [f64; 3]| {
        let place = frame * Isometry3::translation(at[0], at[1], at[2]);
        case.scene.obstacles.push(Obstacle::new(name, Solid::Box(Vector3::from(size)), &place));
    };
    board("lower board", [depth, wide, thick], [0.0, 0.0, -0.5 * room - 0.5 * thick]);
    board("upper board", [depth, wide, thick], [0.0, 0.0, 0.5 * room + 0.5 * thick]);
    board("left side", [depth, thick, room], [0.0, 0.5 * wide, 0.0]);
    board("right side", [depth, thick, room], [0.0, -0.5 * wide, 0.0]);
    board("back", [thick, wide, room], [0.5 * depth + 0.5 * thick, 0.0, 0.0]);
    case.starts_clear(&setting.mechanism).then_some(case)
}

fn hand_at(setting: &Setting, posture: &Posture) -> HandGoal {
    let palm = setting.mechanism.arm.palm(posture);
    HandGoal {
        point: palm * setting.mechanism.grasp_point(),
        approach: palm.rotation * Vector3::z(),
        closing_axis: palm.rotation * Vector3::x(),
        rolls: 0,
        along: palm.rotation * Vector3::z(),
        back: 0.0,
        floor: f64::NEG_INFINITY,
    }
}

/// A posture in the middle of the joint ranges, clear of itself.
fn comfortable(setting: &Setting, random: &mut Pcg64) -> Posture {
    let (mechanism, scene) = (&setting.mechanism, Scene::default());
    let clearance =
        Clearance { mechanism, collision_model: &setting.open, scene: &scene, segment: SegmentKind::Reach };
    loop {
        let mut posture = [0.0; 7];
        for (angle, joint) in posture.iter_mut().zip(&mechanism.arm.joints) {
            let (middle, half) = (
                0.5 * (joint.limits.upper + joint.limits.lower),
                0.5 * (joint.limits.upper - joint.limits.lower),
            );
            *angle = middle + half * random.random_range(-RANGE..RANGE);
        }
        if clearance.is_clear(&posture, CLEAR) {
            return posture;
        }
    }
}
