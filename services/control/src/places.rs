use crate::body::Body;
use crate::errand::Errand;
use crate::request::Request;
use coact_joint_task::{Scene, Shape, Task};
use coact_robot::{Hand, HandGoal};
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
/// How far the pointing hand stays from what it points to, and how far it goes at most, m.
const POINTING: (f64, f64) = (0.25, 0.85);

/// The places of a task as goals of the hand.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    scene: Scene,
    shoulder: Point3<f64>,
    hand: Hand,
    kinds: Vec<Grip>,
    sockets: Vec<Isometry3<f64>>,
}

/// How a kind of part is gripped.
#[derive(Debug, Clone, Copy)]
struct Grip {
    height: f64,
    width: f64,
    /// Rolls that serve: any (0) for round parts, two for parts with flat sides.
    rolls: u32,
    /// Turn of the closing axis about the part's z axis, rad.
    turn: f64,
}

impl Places {
    pub fn new(body: &Body, task: &Task) -> Self {
        Self {
            scene: task.scene.clone(),
            shoulder: body.robot.arm().centres(&body.robot.park)[0],
            hand: body.robot.hand.clone(),
            kinds: task.kinds.iter().map(|kind| grip(kind.width, &kind.shape)).collect(),
            sockets: task.subgoals.iter().map(|subgoal| frame(subgoal.socket, subgoal.axis)).collect(),
        }
    }

    /// The goals of the hand that serve a request; none for standing at rest.
    pub fn goals(&self, request: &Request) -> Vec<HandGoal> {
        let at = Point3::from(request.frame.translation.vector);
        let held = request.held.filter(|(kind, _)| request.kind == Some(*kind));
        match (request.errand, request.kind) {
            (Errand::Place | Errand::Offer | Errand::PutBack, _) => {
                held.map_or_else(Vec::new, |held| self.puts(held, &request.frame, request.errand))
            }
            (Errand::Take, Some(kind)) => vec![self.part(kind, &request.frame)],
            (Errand::Receive, Some(kind)) => {
                let goal = self.part(kind, &request.frame);
                let before = HandGoal { point: goal.point - goal.approach * BACK, back: 0.0, ..goal };
                vec![if request.before { before } else { HandGoal { back: STRAIGHT, ..goal } }]
            }
            (Errand::Ask, _) => vec![self.held_out()],
            (Errand::Steady, _) => vec![self.steadying()],
            (Errand::Point, _) => vec![self.pointing(&at)],
            (Errand::Park | Errand::Take | Errand::Receive, _) => Vec::new(),
        }
    }

    /// The goals with which the held part comes to `place`, as it is held: a round one turned about its own axis at
    /// will, one with flat sides so that it fits.
    fn puts(
        &self,
        (kind, in_palm): (usize, Isometry3<f64>),
        place: &Isometry3<f64>,
        errand: Errand,
    ) -> Vec<HandGoal> {
        let round = self.kinds[kind].rolls == 0;
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
            self.palm_at(&(place * about * in_palm.inverse()), BACK)
        };
        (0..turns).map(goal).collect()
    }

    /// The goal that is reached with the palm there, `back` m before it first.
    pub fn palm_at(&self, palm: &Isometry3<f64>, back: f64) -> HandGoal {
        HandGoal {
            point: palm * self.hand.grasp_point(),
            approach: palm.rotation * Vector3::z(),
            closing: palm.rotation * Vector3::x(),
            rolls: 1,
            back,
            floor: self.scene.table_height,
        }
    }

    /// Width of a kind of part, m.
    pub fn width(&self, kind: usize) -> f64 {
        self.kinds[kind].width
    }

    /// Gripping, or setting down, a part whose frame is `frame`: so deep in the hand that its fingers meet on it.
    pub fn part(&self, kind: usize, frame: &Isometry3<f64>) -> HandGoal {
        let Grip { height, width, rolls, turn } = self.kinds[kind];
        let turned = frame * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
        let goal = HandGoal::grip(&turned, height, rolls, BACK, self.scene.table_height);
        let deeper = self.hand.grasp_distance - self.hand.grasp(width, 0.0).depth;
        HandGoal { point: goal.point + goal.approach * deeper, ..goal }
    }

    /// Where the part of a subgoal belongs.
    pub fn socket(&self, subgoal: usize) -> Isometry3<f64> {
        self.sockets[subgoal]
    }

    /// A place for a part on the table.
    pub fn on_table(&self, at: [f64; 2]) -> Isometry3<f64> {
        Isometry3::translation(at[0], at[1], self.scene.table_height)
    }

    /// Where parts change hands, m.
    pub fn handover(&self) -> Point3<f64> {
        Point3::from(self.scene.handover)
    }

    /// The open hand held out to the handover place: away from the shoulder, raised, so that what lies in the hand
    /// lies at the handover place.
    pub fn held_out(&self) -> HandGoal {
        let out = self.handover() - self.shoulder;
        let level = Vector3::new(out.x, out.y, 0.0).try_normalize(1e-6).unwrap_or_else(Vector3::x);
        let approach = level * RAISED.cos() + Vector3::z() * RAISED.sin();
        let point = self.handover() + approach * (self.hand.grasp_distance - HOLLOW);
        self.free(point, approach, 0.0)
    }

    /// Pressing on the base from above.
    pub fn steadying(&self) -> HandGoal {
        self.free(Point3::from(self.scene.hold), -Vector3::z(), BACK)
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
        HandGoal { point, approach, closing: Vector3::y(), rolls: 0, back, floor: self.scene.table_height }
    }
}

/// How to grip a part `width` wide: a box across the side that is nearer to this width.
fn grip(width: f64, shape: &Shape) -> Grip {
    match *shape {
        Shape::Cylinder { height, .. } => Grip { height, width, rolls: 0, turn: 0.0 },
        Shape::Box { size: [x, y, height] } => {
            let across_y = (y - width).abs() < (x - width).abs();
            let turn = if across_y { std::f64::consts::FRAC_PI_2 } else { 0.0 };
            Grip { height, width, rolls: 2, turn }
        }
    }
}

/// A part's frame at `at` with its z axis along `axis`.
fn frame(at: [f64; 3], axis: [f64; 3]) -> Isometry3<f64> {
    let axis = UnitVector3::try_new(Vector3::from(axis), 1e-9).unwrap_or_else(Vector3::z_axis);
    let about_x = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap_or_else(about_x);
    Isometry3::from_parts(Translation3::from(at), rotation)
}
