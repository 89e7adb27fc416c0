use super::PlanningQuery;
use crate::robot::{GripGoal, GripTable, RobotModel};
use crate::state::Skill;
use coact_joint_task::{Scene, Task};
use coact_motion::Capsule;
use coact_robot::{Hand, HandGoal, NextUse};
use coact_safety::PersonLimits;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, UnitVector3, Vector3};

/// Where the hand goes for each skill: the places of a task as goals of the hand.
#[derive(Debug, Clone)]
pub(crate) struct HandGoals {
    scene: Scene,
    shoulder: Point3<f64>,
    hand: Hand,
    grips: GripTable,
    sockets: Vec<Isometry3<f64>>,
    /// How deep a part goes into each, m.
    depths: Vec<f64>,
}

/// Distance at which the approach to a grasp, or to a place where a part is put, begins, m. Chosen by hand: from there the hand
/// comes straight, between what stands around its goal.
const BACK: f64 = 0.15;
/// How far before the handover place the hand waits for a part that the person gives, or that it requests, m. A trade-off: from farther away it
/// comes later; nearer to the person's hand the guard slows it down on its way there, and it hides from the robot's eye what she brings.
const WAITS: f64 = 0.20;
/// Last part of the way to a part that the person gives, on which the hand moves straight, m. Shorter than elsewhere, for the
/// hand has waited straight before that place already.
const STRAIGHT: f64 = 0.03;
/// Turns about its axis in which a round part is inserted: every 30 degrees.
const ROUND_TURNS: u32 = 12;
/// Turns in which a part with flat sides is put on the table: along its sides.
const FLAT_TURNS: u32 = 4;
/// How far a part falls at most that is laid down as it comes, m. Chosen by hand: room for the error of its height.
const DROPPED: f64 = 0.02;
/// How far the pointing hand stays from what it points to, m. Chosen by hand: near enough to tell which part is meant.
const POINTING_DISTANCE: f64 = 0.25;
/// How far from the shoulder it goes at most, m. Chosen by hand for the reach of our robot's arm.
const POINTING_REACH: f64 = 0.85;
/// Cells along each side of the robot's workspace among which a free place is looked for. Chosen by hand; not sensitive.
const CELLS: usize = 5;

/// Places no farther apart are one, m. Not sensitive: sockets are centimetres apart.
const SAME_PLACE: f64 = 1e-3;

impl HandGoals {
    pub fn new(model: &RobotModel, task: &Task) -> Self {
        Self {
            scene: task.scene.clone(),
            shoulder: model.robot.arm().centres(&model.robot.park)[0],
            hand: model.robot.hand.clone(),
            grips: model.grips.clone(),
            sockets: task.subgoals.iter().map(|subgoal| frame(subgoal.socket, subgoal.axis)).collect(),
            depths: task.subgoals.iter().map(|goal| task.insertion_depth(goal.socket, goal.axis)).collect(),
        }
    }

    /// The goals of the hand that serve a query; none for parking. A hand that only gets ready stops where its approach would begin.
    pub fn of(&self, query: &PlanningQuery) -> Vec<GripGoal> {
        let mut goals = self.of_skill(query);
        if query.prepares {
            for GripGoal { goal, .. } in &mut goals {
                (goal.point, goal.back) = (goal.point - goal.along * goal.back, 0.0);
            }
        }
        goals
    }

    /// The same, without regard to whether the hand only gets ready.
    fn of_skill(&self, query: &PlanningQuery) -> Vec<GripGoal> {
        let at = Point3::from(query.place.translation.vector);
        let held = query.held.filter(|(kind, _)| query.kind == Some(*kind));
        match (query.skill, query.kind) {
            (Skill::PutBack, _) if query.loosely => {
                query.held.map_or_else(Vec::new, |held| vec![self.laying_down(held, &at)])
            }
            (Skill::Insert | Skill::Give | Skill::PutBack, _) => {
                held.map_or_else(Vec::new, |held| self.putting(held, &query.place, query.skill))
            }
            (Skill::Pick, Some(kind)) => self.grasping(kind, query.next_use, &query.place),
            (Skill::Receive, Some(kind)) => {
                self.receiving(kind, &query.place, query.stops_before.then_some(WAITS))
            }
            (Skill::Request, Some(kind)) => self.receiving(kind, &query.place, Some(WAITS)),
            (Skill::Steady, _) => self.steadying(),
            (Skill::Point, _) => vec![self.pointing(&at)],
            (Skill::Park | Skill::Pick | Skill::Request | Skill::Receive, _) => Vec::new(),
        }
    }

    /// The goals with the hand on a part whose frame is `frame`, in all grips that serve what is done next.
    pub fn grasping(&self, kind: usize, next: NextUse, frame: &Isometry3<f64>) -> Vec<GripGoal> {
        self.grips.goals(kind, next, frame, BACK, self.scene.table_height).collect()
    }

    /// The goals with the hand on a part that the person gives, or so far `before` it, m.
    fn receiving(&self, kind: usize, frame: &Isometry3<f64>, before: Option<f64>) -> Vec<GripGoal> {
        let mut goals = self.grasping(kind, NextUse::Anything, frame);
        goals.retain(|goal| goal.grip == Some(self.grips.received(kind)));
        for GripGoal { goal, .. } in &mut goals {
            goal.point -= goal.along * before.unwrap_or(0.0);
            goal.back = if before.is_some() { 0.0 } else { STRAIGHT };
        }
        goals
    }

    /// The goals with which the held part comes to `place`, as it is held: a round one turned about its own axis at
    /// will, one with flat sides so that it fits.
    fn putting(
        &self,
        (kind, in_palm): (usize, Isometry3<f64>),
        place: &Isometry3<f64>,
        skill: Skill,
    ) -> Vec<GripGoal> {
        let turns = match (self.grips.object(kind).flat, skill) {
            (None, _) => ROUND_TURNS,
            (Some(_), Skill::Insert) => 1,
            (Some(_), _) => FLAT_TURNS,
        };
        let goal = |step: u32| {
            let turn = std::f64::consts::TAU * f64::from(step) / f64::from(turns);
            let about = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
            let goal = self.palm_at(&(place * about * in_palm.inverse()), BACK);
            GripGoal { goal: HandGoal { along: place.rotation * -Vector3::z(), ..goal }, grip: None }
        };
        (0..turns).map(goal).collect()
    }

    /// The goal from which the held part, however it is held, comes to lie on the table at `place` when it is let go.
    fn laying_down(&self, (kind, in_palm): (usize, Isometry3<f64>), place: &Point3<f64>) -> GripGoal {
        let object = self.grips.object(kind);
        let ends = [0.0, object.height].map(|z| (in_palm * Point3::new(0.0, 0.0, z)).z);
        let lowest = ends[0].max(ends[1]) + object.half_width();
        let height = (lowest - self.hand.grasp_distance).max(0.0) + DROPPED;
        self.freely(place + Vector3::z() * height, -Vector3::z(), BACK)
    }

    /// The goal that is reached with the palm there, `back` m before it first.
    pub fn palm_at(&self, palm: &Isometry3<f64>, back: f64) -> HandGoal {
        HandGoal {
            point: palm * self.hand.grasp_point(),
            approach: palm.rotation * Vector3::z(),
            closing_axis: palm.rotation * Vector3::x(),
            rolls: 1,
            along: palm.rotation * Vector3::z(),
            back,
            floor: self.scene.table_height,
        }
    }

    /// Where the part of a subgoal belongs.
    pub fn socket(&self, subgoal: usize) -> Isometry3<f64> {
        self.sockets[subgoal]
    }

    /// How deep a part goes that comes to `place`, m; 0 where that is no socket.
    pub fn insertion_depth(&self, place: &Isometry3<f64>) -> f64 {
        self.subgoal_of(place).map_or(0.0, |subgoal| self.depths[subgoal])
    }

    /// The subgoal whose place this is.
    fn subgoal_of(&self, place: &Isometry3<f64>) -> Option<usize> {
        let at = |socket: &Isometry3<f64>| {
            (socket.translation.vector - place.translation.vector).norm() < SAME_PLACE
        };
        self.sockets.iter().position(at)
    }

    /// A part's frame as it is seen; it stands on the table at the lowest.
    pub fn above_table(&self, mut seen: Isometry3<f64>) -> Isometry3<f64> {
        seen.translation.z = seen.translation.z.max(self.scene.table_height);
        seen
    }

    /// A place for a part on the table.
    pub fn on_table(&self, at: [f64; 2]) -> Isometry3<f64> {
        Isometry3::translation(at[0], at[1], self.scene.table_height)
    }

    /// Where parts change hands, m.
    pub fn handover(&self) -> Point3<f64> {
        Point3::from(self.scene.handover)
    }

    /// The same as a part's frame, upright.
    pub fn handover_frame(&self) -> Isometry3<f64> {
        Isometry3::from_parts(self.handover().into(), UnitQuaternion::identity())
    }

    /// Where the person's hand will come with a part in it: capsules around the hand and the part. `part`: the part's, in its
    /// own frame.
    pub fn coming(&self, part: &Capsule, limits: &PersonLimits) -> [Capsule; 2] {
        let part = part.within(&self.handover_frame());
        let start = nalgebra::center(&part.start, &part.end);
        let end = start + self.outwards() * limits.hand_length;
        let [.., radius] = limits.radii;
        [Capsule { start, end, radius }, part]
    }

    /// From the robot's shoulder to the person, on the level.
    fn outwards(&self) -> Vector3<f64> {
        let out = self.handover() - self.shoulder;
        Vector3::new(out.x, out.y, 0.0).try_normalize(1e-6).unwrap_or_else(Vector3::x)
    }

    /// Pressing on the base from above, at any of the places for that.
    pub fn steadying(&self) -> Vec<GripGoal> {
        let places = self.scene.steady.iter().map(|place| Point3::from(*place));
        places.map(|place| self.freely(place, -Vector3::z(), BACK)).collect()
    }

    /// Where the person's hand will be that works at `place`: a capsule around it.
    pub fn working(&self, place: &Isometry3<f64>, limits: &PersonLimits) -> Capsule {
        let start = Point3::from(place.translation.vector);
        let back = Point3::from(self.scene.person_shoulder) - start;
        let end = start + back.try_normalize(1e-6).unwrap_or_else(Vector3::z) * limits.hand_length;
        let [.., radius] = limits.radii;
        Capsule { start, end, radius }
    }

    /// Pointing to `target` from a distance.
    fn pointing(&self, target: &Point3<f64>) -> GripGoal {
        let line = target - self.shoulder;
        let approach = line.try_normalize(1e-6).unwrap_or_else(|| -Vector3::z());
        let way = (line.norm() - POINTING_DISTANCE).clamp(0.0, POINTING_REACH);
        self.freely(self.shoulder + approach * way, approach, 0.0)
    }

    /// The place in the robot's workspace, of a grid, that is farthest from all of `taken`.
    pub fn free_place(&self, taken: impl Iterator<Item = [f64; 3]> + Clone) -> [f64; 2] {
        let [min, max] = self.scene.workspace[0];
        let place = |step: usize, axis: usize| {
            min[axis] + (step as f64 + 0.5) / CELLS as f64 * (max[axis] - min[axis])
        };
        let cells = (0..CELLS * CELLS).map(|cell| [place(cell % CELLS, 0), place(cell / CELLS, 1)]);
        let clearance = |at: &[f64; 2]| {
            let gaps = taken.clone().map(|other| (other[0] - at[0]).hypot(other[1] - at[1]));
            gaps.fold(f64::INFINITY, f64::min)
        };
        let better = |best: ([f64; 2], f64), at: [f64; 2]| {
            let gap = clearance(&at);
            if gap > best.1 { (at, gap) } else { best }
        };
        cells.fold(([0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1])], 0.0), better).0
    }

    /// A goal that the hand reaches turned about its approach in any way.
    fn freely(&self, point: Point3<f64>, approach: Vector3<f64>, back: f64) -> GripGoal {
        let floor = self.scene.table_height;
        let goal =
            HandGoal { point, approach, closing_axis: Vector3::y(), rolls: 0, along: approach, back, floor };
        GripGoal { goal, grip: None }
    }
}

/// A part's frame at `at` with its z axis along `axis`.
fn frame(at: [f64; 3], axis: [f64; 3]) -> Isometry3<f64> {
    let axis = UnitVector3::try_new(Vector3::from(axis), 1e-9).unwrap_or_else(Vector3::z_axis);
    let about_x = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap_or_else(about_x);
    Isometry3::from_parts(Translation3::from(at), rotation)
}
