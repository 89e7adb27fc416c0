//! Movements of a robot that builds something: pick, insert, park.

use crate::{Case, Setting};
use coact_joint_task::{Agent, Fixture, Task};
use coact_motion::{CollisionModel, Goal, Scene};
use coact_robot::{Graspable, Grip, Grips, HandGoal, MotionState, NextUse, Posture};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;

/// Distance of the pose before a grasp or a socket, and of leaving with a part, m: those of published planners in posture
/// space.
const BEFORE: f64 = 0.15;
const LIFT: f64 = 0.05;
/// How deep parts go into their sockets at most, m: the height of the toy vehicle's platform.
const DEEP: f64 = 0.03;
/// Turns about its axis in which a round part is inserted: every 30 degrees. A trade-off with the time of planning.
const TURNS: u32 = 12;
/// How far a part stands from its place in the task at most, along x and along y, m. Chosen by hand.
const MOVED: f64 = 0.02;
/// Height above the table at which a part stands, m: it touches nothing.
const ABOVE_TABLE: f64 = 0.001;
/// How far a start is from the park posture in each joint at most, and from the joint limits at least, rad. Chosen by hand.
const NEAR_PARK: f64 = 0.2;
const FROM_LIMITS: f64 = 0.02;

/// To a part of the robot among others, until the hand is around it.
pub(super) fn pick(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    pick_of(setting, NextUse::Anything, random).map(|pick| pick.case)
}

/// A pick, the index of the part, and the grips that are offered, one for each goal.
struct Pick {
    case: Case,
    part: usize,
    object: Graspable,
    grips: Vec<Grip>,
}

fn pick_of(setting: &Setting, next: NextUse, random: &mut Pcg64) -> Option<Pick> {
    let task = setting.task.as_ref()?;
    let (scene, places) = table(task, random);
    let own: Vec<usize> =
        (0..task.parts.len()).filter(|part| task.parts[*part].workspace == Agent::Robot).collect();
    let part = own[random.random_range(0..own.len())];
    let kind = &task.kinds[task.parts[part].kind];
    let object = coact_workplace::graspable(kind);
    let grips = Grips::of(setting.hand.as_ref()?, object, next);
    let collision_model = setting.with_fingers(&grips.open)?;
    let start = near_park(setting, random);
    let offers = grips.goals(&places[part], BEFORE, f64::NEG_INFINITY);
    let (grips, goals) = offers.into_iter().map(|(index, goal)| (grips.all[index], goal)).unzip();
    let (start, goal) = (start.map(MotionState::at_rest), Goal::Hand(goals));
    let case = Case { collision_model, scene, start, leave: None, goal, insertion_depth: 0.0 };
    case.starts_clear(&setting.mechanism).then_some(Pick { case, part, object, grips })
}

/// With a part that was picked into its socket.
pub(super) fn insert(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    insert_of(setting, random).map(|(case, _)| case)
}

/// An insertion, and the hand as it came to the part.
fn insert_of(setting: &Setting, random: &mut Pcg64) -> Option<(Case, CollisionModel)> {
    let task = setting.task.as_ref()?;
    let Pick { case: picked, part, object, grips } =
        pick_of(setting, NextUse::Insert { depth: DEEP }, random)?;
    let name = part_name(part);
    let plan = picked.problem(&setting.mechanism).plan().ok()?;
    let target = plan.target?;
    let kind_index = task.parts[part].kind;
    let kind = &task.kinds[kind_index];
    let goal = task.subgoals.iter().find(|goal| goal.kind == kind_index && goal.side == Agent::Robot)?;
    let Goal::Hand(goals) = &picked.goal else { return None };
    let palm = setting.mechanism.arm.palm(&target.at);
    let mut scene = picked.scene.touching(&[Fixture::TABLE, Fixture::PLATFORM]);
    let index = scene.obstacles.iter().position(|obstacle| obstacle.name == name)?;
    let centre = scene.obstacles.remove(index).place;
    let frame = centre * Isometry3::translation(0.0, 0.0, -0.5 * kind.shape.height());
    let fingers = grips[target.goal].fingers(setting.hand.as_ref()?, &object, 0.0);
    let closed = setting.with_fingers(&fingers)?;
    let (solid, within) = coact_workplace::solid(kind.shape);
    let collision_model =
        closed.holding(&setting.mechanism, &name, solid, &(palm.inverse() * frame * within));
    let socket = along(goal.socket, goal.axis);
    // The part goes into its socket as it is held, turned about its own axis at will if it is round.
    let in_part = frame.inverse() * palm;
    let turns = if object.flat.is_none() { TURNS } else { 1 };
    let goals = (0..turns).map(|side| {
        let turn = std::f64::consts::TAU * f64::from(side) / f64::from(turns);
        let place = socket * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) * in_part;
        HandGoal {
            point: place * setting.mechanism.grasp_point(),
            approach: place.rotation * Vector3::z(),
            closing_axis: place.rotation * Vector3::x(),
            rolls: 1,
            along: -(socket * Vector3::z()),
            ..goals[target.goal]
        }
    });
    let goals = goals.collect();
    let case = Case {
        collision_model,
        scene,
        start: plan.end().map(MotionState::at_rest),
        leave: Some((Vector3::z(), LIFT)),
        goal: Goal::Hand(goals),
        insertion_depth: DEEP,
    };
    Some((case, picked.collision_model))
}

/// From a socket back to rest, with fingers that have let the part go as they came to it.
pub(super) fn park(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    let (inserted, collision_model) = insert_of(setting, random)?;
    let plan = inserted.problem(&setting.mechanism).plan().ok()?;
    let palm = setting.mechanism.arm.palm(&plan.end());
    Some(Case {
        collision_model,
        scene: inserted.scene.clone(),
        start: plan.end().map(MotionState::at_rest),
        leave: Some((palm.rotation * -Vector3::z(), BEFORE)),
        goal: Goal::Posture(setting.mechanism.park),
        insertion_depth: 0.0,
    })
}

/// The task's table, with every part moved a little from its place.
fn table(task: &Task, random: &mut Pcg64) -> (Scene, Vec<Isometry3<f64>>) {
    let mut scene = Scene { obstacles: coact_workplace::fixtures(task), ..Scene::default() };
    let mut places = Vec::new();
    for (index, part) in task.parts.iter().enumerate() {
        let [x, y] = part.at.map(|at| at + random.random_range(-MOVED..MOVED));
        let place = Isometry3::translation(x, y, task.scene.table_height + ABOVE_TABLE);
        scene.obstacles.push(coact_workplace::upright(
            &part_name(index),
            task.kinds[part.kind].shape,
            &place,
        ));
        places.push(place);
    }
    (scene, places)
}

fn part_name(index: usize) -> String {
    format!("part {index}")
}

fn along(at: [f64; 3], axis: [f64; 3]) -> Isometry3<f64> {
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &Vector3::from(axis)).unwrap_or_default();
    Isometry3::from_parts(Translation3::from(at), turn)
}

fn near_park(setting: &Setting, random: &mut Pcg64) -> Posture {
    let limits = setting.mechanism.limits();
    std::array::from_fn(|joint| {
        let angle = setting.mechanism.park[joint] + random.random_range(-NEAR_PARK..NEAR_PARK);
        angle.clamp(limits[joint].lower + FROM_LIMITS, limits[joint].upper - FROM_LIMITS)
    })
}
