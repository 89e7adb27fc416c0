use crate::Case;
use coact_joint_task::{Agent, Shape, Task};
use coact_motion::{Aim, Body, Clearance, Mechanism, Obstacle, Scene, Solid, workplace};
use coact_robot::{Hand, HandGoal, MotionState, Posture, Robot};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;

/// Who moves, and at which task.
#[derive(Debug, Clone)]
pub struct Setting {
    /// The arm.
    pub mechanism: Mechanism,
    /// Its hand, when it is a robot of ours.
    pub hand: Option<Hand>,
    /// The task at which it picks and inserts.
    pub task: Option<Task>,
    /// The open hand.
    pub open: Body,
}

/// A kind of movement of the suite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenario {
    /// From anywhere to anywhere, with nothing around.
    FreeReach,
    /// To a part among others on the table, until the hand is around it.
    Pick,
    /// With a part from the table into its socket.
    Insert,
    /// From a socket back to rest.
    Park,
    /// Into a shelf.
    Shelf,
    /// Past one small obstacle.
    PastSmall,
    /// Past one tall obstacle.
    PastTall,
    /// Past two obstacles, a small one and a tall one.
    PastTwo,
}

impl Setting {
    /// A robot of ours at a task.
    ///
    /// # Errors
    /// What is wrong with the robot's collision geometry.
    pub fn of(robot: &Robot, task: Task) -> Result<Self, coact_robot::RobotError> {
        let mechanism = Mechanism::of(robot)?;
        let hand = robot.hand.clone();
        let open = fingers(&mechanism, &hand, OPEN)?;
        Ok(Self { mechanism, hand: Some(hand), task: Some(task), open })
    }

    /// An arm that only a URDF describes.
    ///
    /// # Errors
    /// What is wrong with its collision geometry.
    pub fn foreign(mechanism: Mechanism) -> Result<Self, coact_robot::RobotError> {
        let open = mechanism.body(&|_| 0.0)?;
        Ok(Self { mechanism, hand: None, task: None, open })
    }
}

/// Clear width of the open hand, m, and how much wider than a part it opens.
const OPEN: f64 = 0.10;
const WIDER: f64 = 0.04;
/// Distance of the pose before a grasp or a socket, and of leaving, m.
const BEFORE: f64 = 0.15;
const AWAY: f64 = 0.05;
/// Sides from which an upright part is gripped.
const SIDES: u32 = 12;

impl Scenario {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::FreeReach,
        Self::Pick,
        Self::Insert,
        Self::Park,
        Self::Shelf,
        Self::PastSmall,
        Self::PastTall,
        Self::PastTwo,
    ];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::FreeReach => "free-reach",
            Self::Pick => "pick",
            Self::Insert => "insert",
            Self::Park => "park",
            Self::Shelf => "shelf",
            Self::PastSmall => "past-small",
            Self::PastTall => "past-tall",
            Self::PastTwo => "past-two",
        }
    }

    /// Median time of planning that it may take, and its 99th percentile where that is bounded, ms.
    pub fn budget_ms(self) -> (f64, Option<f64>) {
        match self {
            Self::FreeReach => (5.0, None),
            Self::Pick => (50.0, Some(200.0)),
            Self::Insert | Self::PastSmall | Self::PastTall | Self::PastTwo => (50.0, None),
            Self::Park => (20.0, None),
            Self::Shelf => (200.0, None),
        }
    }

    /// Whether it needs a task, and so a robot of ours.
    pub fn needs_task(self) -> bool {
        matches!(self, Self::Pick | Self::Insert | Self::Park)
    }

    /// A random case of it; none when none was drawn that starts clear of everything.
    pub fn case(self, setting: &Setting, random: &mut Pcg64) -> Option<Case> {
        match self {
            Self::FreeReach => Some(free_reach(setting, random)),
            Self::Pick => retry(|| pick(setting, random)),
            Self::Insert => retry(|| insert(setting, random)),
            Self::Park => retry(|| park(setting, random)),
            Self::Shelf => retry(|| shelf(setting, random)),
            Self::PastSmall => retry(|| past(setting, random, &[SMALL])),
            Self::PastTall => retry(|| past(setting, random, &[TALL])),
            Self::PastTwo => retry(|| past(setting, random, &[SMALL, TALL])),
        }
    }
}

/// Draws until a case is sound, or all [`DRAWS`] are used up.
fn retry(draw: impl FnMut() -> Option<Case>) -> Option<Case> {
    std::iter::repeat_with(draw).take(DRAWS).flatten().next()
}

/// Cases that are drawn at most until one is sound.
const DRAWS: usize = 200;

/// Share of the joint ranges, about their middles, from which starts and goals of reaches are drawn.
const RANGE: f64 = 0.6;
/// Radius and height of obstacles, m.
const SMALL: (f64, f64) = (0.03, 0.16);
const TALL: (f64, f64) = (0.04, 0.60);

fn free_reach(setting: &Setting, random: &mut Pcg64) -> Case {
    loop {
        let (from, to) = (comfortable(setting, random), comfortable(setting, random));
        let goal = hand_at(setting, &to);
        let start = setting.mechanism.arm.palm(&from) * setting.mechanism.grasp_point();
        if (start - goal.point).norm() > 0.25 {
            return Case {
                body: setting.open.clone(),
                scene: Scene::default(),
                start: from.map(MotionState::at_rest),
                leave: None,
                aim: Aim::Hand(vec![goal]),
            };
        }
    }
}

/// A reach past upright cylinders that stand between start and goal.
fn past(setting: &Setting, random: &mut Pcg64, sizes: &[(f64, f64)]) -> Option<Case> {
    let mut case = free_reach(setting, random);
    let Aim::Hand(goals) = &case.aim else { return None };
    let grasp = |posture: &Posture| setting.mechanism.arm.palm(posture) * setting.mechanism.grasp_point();
    let from = grasp(&case.start.map(|state| state.position));
    let way = goals[0].point - from;
    for (index, &(radius, height)) in sizes.iter().enumerate() {
        let share = (index as f64 + random.random_range(0.8..1.2)) / (sizes.len() as f64 + 1.0);
        let aside = Vector3::new(random.random_range(-0.05..0.05), random.random_range(-0.05..0.05), 0.0);
        let centre = from + way * share + aside;
        let place = Isometry3::translation(centre.x, centre.y, centre.z);
        let solid = Solid::Cylinder { radius, height };
        case.scene.obstacles.push(Obstacle::new(format!("obstacle {}", index + 1), solid, &place));
    }
    let goal_is_free = leaves_room(setting, &case, goals);
    (starts_clear(setting, &case) && goal_is_free).then_some(case)
}

/// Whether a posture at the goal exists that is clear: drawn cases without one say nothing about ways.
fn leaves_room(setting: &Setting, case: &Case, goals: &[HandGoal]) -> bool {
    goals.iter().any(|goal| {
        case.scene.obstacles.iter().all(|obstacle| {
            let centre = Point3::from(obstacle.place.translation.vector);
            let apart = centre - goal.point;
            apart.x.hypot(apart.y) > 0.12
        })
    }) && !setting.open.bones().is_empty()
}

/// Two boards, a back and two sides, with a little more than the hand's own room between them.
fn shelf(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    let mut case = free_reach(setting, random);
    let Aim::Hand(goals) = &mut case.aim else { return None };
    let goal = &mut goals[0];
    let flat = Vector3::new(goal.approach.x, goal.approach.y, 0.0);
    if flat.norm() < 0.8 {
        return None;
    }
    goal.approach = flat.normalize();
    goal.rolls = 0;
    goal.back = 0.15;
    let turn = UnitQuaternion::rotation_between(&Vector3::x(), &goal.approach)?;
    let frame = Isometry3::from_parts(Translation3::from(goal.point.coords), turn);
    let room = random.random_range(0.22..0.30);
    let (depth, wide, thick) = (0.22, 0.40, 0.02);
    let mut board = |name: &str, size: [f64; 3], at: [f64; 3]| {
        let place = frame * Isometry3::translation(at[0], at[1], at[2]);
        case.scene.obstacles.push(Obstacle::new(name, Solid::Box(Vector3::from(size)), &place));
    };
    board("lower board", [depth, wide, thick], [0.0, 0.0, -0.5 * room - 0.5 * thick]);
    board("upper board", [depth, wide, thick], [0.0, 0.0, 0.5 * room + 0.5 * thick]);
    board("left side", [depth, thick, room], [0.0, 0.5 * wide, 0.0]);
    board("right side", [depth, thick, room], [0.0, -0.5 * wide, 0.0]);
    board("back", [thick, wide, room], [0.5 * depth + 0.5 * thick, 0.0, 0.0]);
    starts_clear(setting, &case).then_some(case)
}

fn pick(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    pick_of(setting, random).map(|(case, _)| case)
}

/// A pick, and the index of the part.
fn pick_of(setting: &Setting, random: &mut Pcg64) -> Option<(Case, usize)> {
    let task = setting.task.as_ref()?;
    let (scene, places) = table(task, random);
    let own: Vec<usize> =
        (0..task.parts.len()).filter(|part| task.parts[*part].workspace == Agent::Robot).collect();
    let part = own[random.random_range(0..own.len())];
    let kind = &task.kinds[task.parts[part].kind];
    let hand = setting.hand.as_ref()?;
    let body = fingers(&setting.mechanism, hand, kind.width + WIDER).ok()?;
    let start = near_park(setting, random);
    let aim = Aim::Hand(grips(&places[part], workplace::height(kind)));
    let case = Case { body, scene, start: start.map(MotionState::at_rest), leave: None, aim };
    starts_clear(setting, &case).then_some((case, part))
}

fn insert(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    let task = setting.task.as_ref()?;
    let (picked, part) = pick_of(setting, random)?;
    let name = part_name(part);
    let plan = picked.problem(&setting.mechanism).plan().ok()?;
    let target = plan.target?;
    let kind_index = task.parts[part].kind;
    let kind = &task.kinds[kind_index];
    let goal = task.subgoals.iter().find(|goal| goal.kind == kind_index && goal.side == Agent::Robot)?;
    let Aim::Hand(goals) = &picked.aim else { return None };
    let palm = setting.mechanism.arm.palm(&target.at);
    let mut scene = picked.scene.touching(&[workplace::TABLE, workplace::PLATFORM]);
    let index = scene.obstacles.iter().position(|obstacle| obstacle.name == name)?;
    let centre = scene.obstacles.remove(index).place;
    let frame = centre * Isometry3::translation(0.0, 0.0, -0.5 * workplace::height(kind));
    let hand = setting.hand.as_ref()?;
    let closed = fingers(&setting.mechanism, hand, kind.width).ok()?;
    let (solid, within) = workplace::form(kind);
    let body = closed.holding(&setting.mechanism, &name, solid, &(palm.inverse() * frame * within));
    let socket = along(goal.socket, goal.axis);
    // The part goes into its socket as it is held, turned about its own axis at will if it is round.
    let in_part = frame.inverse() * palm;
    let turns = if matches!(kind.shape, Shape::Cylinder { .. }) { SIDES } else { 1 };
    let goals = (0..turns).map(|side| {
        let turn = std::f64::consts::TAU * f64::from(side) / f64::from(turns);
        let place = socket * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) * in_part;
        HandGoal {
            point: place * setting.mechanism.grasp_point(),
            approach: place.rotation * Vector3::z(),
            closing: place.rotation * Vector3::x(),
            rolls: 1,
            ..goals[target.goal]
        }
    });
    let goals = goals.collect();
    let case = Case {
        body,
        scene,
        start: plan.end().map(MotionState::at_rest),
        leave: Some((Vector3::z(), AWAY)),
        aim: Aim::Hand(goals),
    };
    Some(case)
}

fn park(setting: &Setting, random: &mut Pcg64) -> Option<Case> {
    let inserted = insert(setting, random)?;
    let plan = inserted.problem(&setting.mechanism).plan().ok()?;
    let palm = setting.mechanism.arm.palm(&plan.end());
    Some(Case {
        body: setting.open.clone(),
        scene: inserted.scene.clone(),
        start: plan.end().map(MotionState::at_rest),
        leave: Some((palm.rotation * -Vector3::z(), BEFORE)),
        aim: Aim::Posture(setting.mechanism.park),
    })
}

/// The task's table, with every part moved a little from its place.
fn table(task: &Task, random: &mut Pcg64) -> (Scene, Vec<Isometry3<f64>>) {
    let mut scene = Scene { obstacles: workplace::fixtures(task), ..Scene::default() };
    let mut places = Vec::new();
    for (index, part) in task.parts.iter().enumerate() {
        let [x, y] = part.at.map(|at| at + random.random_range(-0.02..0.02));
        let place = Isometry3::translation(x, y, task.scene.table_height + 0.001);
        scene.obstacles.push(workplace::part(&part_name(index), &task.kinds[part.kind], &place));
        places.push(place);
    }
    (scene, places)
}

/// Grips of an upright part: from above, and from all sides.
fn grips(frame: &Isometry3<f64>, height: f64) -> Vec<HandGoal> {
    let mut goals = vec![HandGoal::grip(frame, height, 0, BEFORE, f64::NEG_INFINITY)];
    for side in 0..SIDES {
        let turn = std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
        goals.push(HandGoal::grip_from_side(frame, height, turn, BEFORE));
    }
    goals
}

fn part_name(index: usize) -> String {
    format!("part {index}")
}

fn along(at: [f64; 3], axis: [f64; 3]) -> Isometry3<f64> {
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &Vector3::from(axis)).unwrap_or_default();
    Isometry3::from_parts(Translation3::from(at), turn)
}

fn fingers(mechanism: &Mechanism, hand: &Hand, width: f64) -> Result<Body, coact_robot::RobotError> {
    let posture = hand.posture(hand.base_for_width(width));
    let angle = |name: &str| {
        let index = hand.joints.iter().position(|joint| joint.name == name);
        index.map_or(0.0, |index| posture[index])
    };
    mechanism.body(&angle)
}

fn hand_at(setting: &Setting, posture: &Posture) -> HandGoal {
    let palm = setting.mechanism.arm.palm(posture);
    HandGoal {
        point: palm * setting.mechanism.grasp_point(),
        approach: palm.rotation * Vector3::z(),
        closing: palm.rotation * Vector3::x(),
        rolls: 0,
        back: 0.0,
        floor: f64::NEG_INFINITY,
    }
}

/// A posture in the middle of the joint ranges, clear of itself.
fn comfortable(setting: &Setting, random: &mut Pcg64) -> Posture {
    let (mechanism, scene) = (&setting.mechanism, Scene::default());
    let clearance = Clearance { mechanism, body: &setting.open, scene: &scene, touching: false };
    loop {
        let mut posture = [0.0; 7];
        for (angle, joint) in posture.iter_mut().zip(&mechanism.arm.joints) {
            let (middle, half) = (
                0.5 * (joint.limits.upper + joint.limits.lower),
                0.5 * (joint.limits.upper - joint.limits.lower),
            );
            *angle = middle + half * random.random_range(-RANGE..RANGE);
        }
        if clearance.is_clear(&posture, 0.02) {
            return posture;
        }
    }
}

fn near_park(setting: &Setting, random: &mut Pcg64) -> Posture {
    let limits = setting.mechanism.limits();
    std::array::from_fn(|joint| {
        let angle = setting.mechanism.park[joint] + random.random_range(-0.2..0.2);
        angle.clamp(limits[joint].lower + 0.02, limits[joint].upper - 0.02)
    })
}

fn starts_clear(setting: &Setting, case: &Case) -> bool {
    let clearance =
        Clearance { mechanism: &setting.mechanism, body: &case.body, scene: &case.scene, touching: false };
    clearance.is_clear(&case.start.map(|state| state.position), 0.02)
}
