use crate::body::Body;
use crate::errand::Errand;
use crate::holds::Holds;
use crate::person::PersonArm;
use crate::request::Request;
use coact_joint_task::{Scene, Task};
use coact_motion::Capsule;
use coact_robot::{Hand, HandGoal, NextUse};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, UnitVector3, Vector3};

/// Distance of the pose before a grasp or a placing from the goal, m.
pub(crate) const BACK: f64 = 0.15;
/// Rest of the way from there to a part that the person holds out, on which the hand moves straight, m.
const STRAIGHT: f64 = 0.03;
/// Turns in which a round part is put into its socket, and in which one with flat sides is put on the table.
const TURNS: [u32; 2] = [12, 4];
/// How far the palm of the held-out hand is raised above the horizontal, rad (15 degrees).
const RAISED: f64 = 0.262;
/// Distance from the palm to the middle of the held-out hand, m.
const HOLLOW: f64 = 0.065;
/// How far before the handover place the open hand is held out: the person's comes there, m.
const SHORT: f64 = 0.22;
/// How far a part falls at most that is laid down as it comes, m.
const DROPPED: f64 = 0.02;
/// How far the pointing hand stays from what it points to, and how far it goes at most, m.
const POINTING: (f64, f64) = (0.25, 0.85);

/// The places of a task as goals of the hand.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    scene: Scene,
    shoulder: Point3<f64>,
    hand: Hand,
    holds: Holds,
    sockets: Vec<Isometry3<f64>>,
}

/// A goal of the hand, and the hold in which it takes a part there, if it does.
pub(crate) type Offer = (HandGoal, Option<usize>);

impl Places {
    pub fn new(body: &Body, task: &Task) -> Self {
        Self {
            scene: task.scene.clone(),
            shoulder: body.robot.arm().centres(&body.robot.park)[0],
            hand: body.robot.hand.clone(),
            holds: body.holds.clone(),
            sockets: task.subgoals.iter().map(|subgoal| frame(subgoal.socket, subgoal.axis)).collect(),
        }
    }

    /// The goals of the hand that serve a request; none for standing at rest.
    pub fn goals(&self, request: &Request) -> Vec<Offer> {
        let at = Point3::from(request.frame.translation.vector);
        let held = request.held.filter(|(kind, _)| request.kind == Some(*kind));
        match (request.errand, request.kind) {
            (Errand::PutBack, _) if request.loosely => {
                request.held.map_or_else(Vec::new, |held| vec![self.lays_down(held, &at)])
            }
            (Errand::Place | Errand::Offer | Errand::PutBack, _) => {
                held.map_or_else(Vec::new, |held| self.puts(held, &request.frame, request.errand))
            }
            (Errand::Take, Some(kind)) => self.takes(kind, request.purpose, &request.frame),
            (Errand::Receive, Some(kind)) => self.receives(kind, &request.frame, request.before),
            (Errand::Ask, _) => vec![(self.held_out(), None)],
            (Errand::Steady, _) => vec![(self.steadying(), None)],
            (Errand::Point, _) => vec![(self.pointing(&at), None)],
            (Errand::Park | Errand::Take | Errand::Receive, _) => Vec::new(),
        }
    }

    /// The goals with the hand on a part whose frame is `frame`, in all holds that serve what is done next.
    pub fn takes(&self, kind: usize, next: NextUse, frame: &Isometry3<f64>) -> Vec<Offer> {
        let goals = self.holds.goals(kind, next, frame, BACK, self.scene.table_height);
        goals.map(|(goal, hold)| (goal, Some(hold))).collect()
    }

    /// The goals with the hand on a part that the person holds out, or before it.
    fn receives(&self, kind: usize, frame: &Isometry3<f64>, before: bool) -> Vec<Offer> {
        let mut goals = self.takes(kind, NextUse::Anything, frame);
        goals.retain(|(_, hold)| *hold == Some(self.holds.received(kind)));
        for (goal, _) in &mut goals {
            goal.point -= if before { goal.along * BACK } else { Vector3::zeros() };
            goal.back = if before { 0.0 } else { STRAIGHT };
        }
        goals
    }

    /// The goals with which the held part comes to `place`, as it is held: a round one turned about its own axis at
    /// will, one with flat sides so that it fits.
    fn puts(
        &self,
        (kind, in_palm): (usize, Isometry3<f64>),
        place: &Isometry3<f64>,
        errand: Errand,
    ) -> Vec<Offer> {
        let round = self.holds.form(kind).flat.is_none();
        let turns = if round {
            TURNS[0]
        } else if errand == Errand::Place {
            1
        } else {
            TURNS[1]
        };
        let goal = |step: u32| {
            let turn = std::f64::consts::TAU * f64::from(step) / f64::from(turns);
            let about = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
            let goal = self.palm_at(&(place * about * in_palm.inverse()), BACK);
            (HandGoal { along: place.rotation * -Vector3::z(), ..goal }, None)
        };
        (0..turns).map(goal).collect()
    }

    /// The goal from which the held part, however it is held, comes to lie on the table at `place` when it is let go.
    fn lays_down(&self, (kind, in_palm): (usize, Isometry3<f64>), place: &Point3<f64>) -> Offer {
        let form = self.holds.form(kind);
        let ends = [0.0, form.height].map(|z| (in_palm * Point3::new(0.0, 0.0, z)).z);
        let lowest = ends[0].max(ends[1]) + form.half_width();
        let height = (lowest - self.hand.grasp_distance).max(0.0) + DROPPED;
        (self.free(place + Vector3::z() * height, -Vector3::z(), BACK), None)
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
    pub fn meeting(&self) -> Isometry3<f64> {
        Isometry3::from_parts(self.handover().into(), UnitQuaternion::identity())
    }

    /// The open hand held out to the handover place, and short of it: away from the shoulder, raised.
    pub fn held_out(&self) -> HandGoal {
        let level = self.outwards();
        let approach = level * RAISED.cos() + Vector3::z() * RAISED.sin();
        let point = self.handover() - level * SHORT + approach * (self.hand.grasp_distance - HOLLOW);
        self.free(point, approach, 0.0)
    }

    /// Where the person's hand will come with a part in it: capsules around the hand and the part. `hull`: the part's, in its
    /// own frame.
    pub fn coming(&self, hull: &Capsule) -> [Capsule; 2] {
        let part = hull.within(&self.meeting());
        let start = nalgebra::center(&part.start, &part.end);
        let hand =
            Capsule { start, end: start + self.outwards() * PersonArm::HAND, radius: PersonArm::RADII[2] };
        [hand, part]
    }

    /// From the robot's shoulder to the person, on the level.
    fn outwards(&self) -> Vector3<f64> {
        let out = self.handover() - self.shoulder;
        Vector3::new(out.x, out.y, 0.0).try_normalize(1e-6).unwrap_or_else(Vector3::x)
    }

    /// Pressing on the base from above.
    pub fn steadying(&self) -> HandGoal {
        self.free(Point3::from(self.scene.steady), -Vector3::z(), BACK)
    }

    /// Pointing to `target` from a distance.
    pub fn pointing(&self, target: &Point3<f64>) -> HandGoal {
        let line = target - self.shoulder;
        let approach = line.try_normalize(1e-6).unwrap_or_else(|| -Vector3::z());
        let way = (line.norm() - POINTING.0).clamp(0.0, POINTING.1);
        self.free(self.shoulder + approach * way, approach, 0.0)
    }

    /// The place in the robot's workspace, of a grid of 25, that is farthest from all of `taken`.
    pub fn free_place(&self, taken: impl Iterator<Item = [f64; 3]> + Clone) -> [f64; 2] {
        let [min, max] = self.scene.workspace[0];
        let place = |step: usize, axis: usize, cells: usize| {
            min[axis] + (step as f64 + 0.5) / cells as f64 * (max[axis] - min[axis])
        };
        let cells = (0..25).map(|cell| [place(cell % 5, 0, 5), place(cell / 5, 1, 5)]);
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

    fn free(&self, point: Point3<f64>, approach: Vector3<f64>, back: f64) -> HandGoal {
        let floor = self.scene.table_height;
        HandGoal { point, approach, closing_axis: Vector3::y(), rolls: 0, along: approach, back, floor }
    }
}

/// A part's frame at `at` with its z axis along `axis`.
fn frame(at: [f64; 3], axis: [f64; 3]) -> Isometry3<f64> {
    let axis = UnitVector3::try_new(Vector3::from(axis), 1e-9).unwrap_or_else(Vector3::z_axis);
    let about_x = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap_or_else(about_x);
    Isometry3::from_parts(Translation3::from(at), rotation)
}
