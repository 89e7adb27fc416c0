use crate::answer::Answer;
use crate::body::{Body, Fingers};
use crate::course::Course;
use crate::errand::Errand;
use crate::person::PersonArm;
use crate::places::{Offer, Places};
use crate::request::Request;
use coact_joint_task::{Fixture, Shape, Task};
use coact_motion::{Aim, Margin, Mechanism, Obstacle, Plan, Problem, Refusal, Scene, Solid, workplace};
use coact_robot::{HAND_JOINTS, HandGoal, MotionState, RobotError};
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

/// Answers control's questions for movements, among all that is known of the surroundings. Allocates and takes
/// milliseconds: it works beside the servo, never in its cycle.
#[derive(Debug)]
pub(crate) struct Planner {
    body: Body,
    mechanism: Mechanism,
    places: Places,
    shapes: Vec<Shape>,
    fixtures: Vec<Obstacle>,
}

/// Distances that are kept: fingers around something low stand hardly higher than what it lies on.
const MARGIN: Margin = Margin { way: 0.01, goal: 0.001 };
/// Postures that a search looks at, in motion and at rest: it ends before the person wonders.
const EFFORT: (u32, u32) = (1_000, 4_000);
/// How deep parts go into their places at most, m.
pub(crate) const GUIDE: f64 = 0.03;
/// What is nearer than this to where the hand works may be touched by it there, m.
const NEIGHBOURS: f64 = 0.04;
/// A part of the same kind this near to where one is meant is that one, m.
const SAME: f64 = 0.06;
/// Parts this near to the person's arm are in the person's hand, m.
const IN_HAND: f64 = 0.05;
/// How far ahead the person's arm is kept clear of as well, s.
const AHEAD: f64 = 0.3;
/// How far the hand gets out of a place from which no movement was found, m.
const WITHDRAWAL: f64 = 0.08;
/// Name of the person's arm among the obstacles.
const PERSON: &str = "person";

impl Planner {
    pub fn new(body: Body, places: Places, task: &Task) -> Result<Self, RobotError> {
        Ok(Self {
            mechanism: Mechanism::of(&body.robot)?,
            places,
            shapes: task.kinds.iter().map(|kind| kind.shape).collect(),
            fixtures: workplace::fixtures(task),
            body,
        })
    }

    /// Arm and hand with the fingers at these angles, rad, around or on what is held.
    pub fn figure(
        &self,
        fingers: &[f64; HAND_JOINTS],
        held: Option<(usize, Isometry3<f64>)>,
    ) -> Result<coact_motion::Body, RobotError> {
        let figure = self.mechanism.with_fingers(&self.body.robot.hand, fingers)?;
        Ok(match held {
            None => figure,
            Some((kind, in_palm)) => {
                let (solid, centre) = workplace::form(self.shapes[kind]);
                figure.holding(&self.mechanism, "the held part", solid, &(in_palm * centre))
            }
        })
    }

    /// The mechanism that it plans for.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// Whether the arm can get to one of these goals when nothing is in the way.
    pub fn reaches(&self, goals: Vec<HandGoal>) -> Result<bool, RobotError> {
        let (body, scene) = (self.figure(&self.body.fingers(Fingers::Slender), None)?, Scene::default());
        let start = self.mechanism.park.map(MotionState::at_rest);
        let problem = self.problem(&body, &scene, start, Aim::Hand(goals));
        Ok(!problem.targets_from(&self.mechanism.park).is_empty())
    }

    /// The movement that is asked for, one that only gets the hand free, or none.
    pub fn answer(&mut self, request: &Request) -> Answer {
        let refused = Answer { id: request.id, course: None, hold: None, withdraws: false };
        let wanted = self.body.on_the_way(request.errand, request.kind, request.hold);
        let offers = self.places.goals(request);
        let (scene, alone) =
            (self.scene(request, &offers), self.scene(&Request { person: None, ..*request }, &offers));
        // Where the person leaves no way, the arm goes as far as the guard lets it; where the fingers cannot move with
        // the hand as they shall stand in the end, they go as they stand now.
        for (fingers, scene) in [
            (self.body.fingers(wanted), &scene),
            (self.body.fingers(wanted), &alone),
            (request.fingers, &alone),
        ] {
            let Ok(figure) = self.figure(&fingers, request.held) else { return refused };
            if let Ok(plan) = self.plan(request, &figure, scene, &offers) {
                let hold = plan.target.and_then(|target| offers.get(target.goal)?.1);
                return Answer { course: Course::of(&plan), hold, ..refused };
            }
        }
        if request.is_in_motion() {
            return refused;
        }
        let Ok(figure) = self.figure(&request.fingers, request.held) else { return refused };
        let withdrawn = self.withdraw(request, &figure, &scene);
        Answer { course: withdrawn.as_ref().and_then(Course::of), withdraws: true, ..refused }
    }

    fn plan(
        &self,
        request: &Request,
        figure: &coact_motion::Body,
        scene: &Scene,
        offers: &[Offer],
    ) -> Result<Plan, Refusal> {
        let aim = match request.errand {
            Errand::Park => Aim::Posture(self.mechanism.park),
            _ => Aim::Hand(offers.iter().map(|(goal, _)| *goal).collect()),
        };
        let puts = matches!(request.errand, Errand::Place | Errand::PutBack);
        let guide = if puts { GUIDE } else { 0.0 };
        let then = request.next.map(|next| next * request.frame.inverse()).into_iter().collect();
        let problem = self.problem(figure, scene, request.start, aim);
        let problem = Problem { leave: request.leave, then, guide, ..problem };
        problem.plan_within(if request.is_in_motion() { EFFORT.0 } else { EFFORT.1 })
    }

    /// Straight back out of a place that no movement leaves, or up.
    fn withdraw(&self, request: &Request, figure: &coact_motion::Body, scene: &Scene) -> Option<Plan> {
        let palm = self.mechanism.arm.palm(&request.start.map(|state| state.position));
        let back = palm.rotation * -Vector3::z();
        let margin = Margin { way: 0.0, goal: 0.0 };
        // The hand may touch, on its way out, whatever it stands too near to.
        let names = scene.obstacles.iter().map(|obstacle| obstacle.name.as_str());
        let scene = &scene.touching(&names.collect::<Vec<_>>());
        [back, Vector3::z()].iter().find_map(|direction| {
            let away = Translation3::from(direction * WITHDRAWAL) * palm;
            let goal = self.places.palm_at(&away, 0.0);
            let problem = self.problem(figure, scene, request.start, Aim::Hand(vec![goal]));
            Problem { leave: Some((*direction, 0.9 * WITHDRAWAL)), margin, ..problem }.plan().ok()
        })
    }

    fn problem<'a>(
        &'a self,
        body: &'a coact_motion::Body,
        scene: &'a Scene,
        start: [MotionState; 7],
        aim: Aim,
    ) -> Problem<'a> {
        let mechanism = &self.mechanism;
        Problem {
            mechanism,
            body,
            scene,
            start,
            leave: None,
            aim,
            then: Vec::new(),
            guide: 0.0,
            margin: MARGIN,
        }
    }

    /// All that the arm keeps clear of now.
    fn scene(&self, request: &Request, offers: &[Offer]) -> Scene {
        let mut obstacles = self.fixtures.clone();
        obstacles.extend(self.parts(request));
        for [x, y, z, half_x, half_y, half_z] in &request.screens[..request.screened] {
            let edges = 2.0 * Vector3::new(*half_x, *half_y, *half_z);
            obstacles.push(Obstacle::new("screen", Solid::Box(edges), &Isometry3::translation(*x, *y, *z)));
        }
        let person = request.person.as_ref().map(|arm| person(arm, request.errand.meets()));
        obstacles.extend(person.into_iter().flatten());
        let touchable = self.touchable(request, offers, &obstacles);
        Scene { obstacles, touchable }
    }

    /// The parts in sight, but for what is in a hand; the one that is meant stands where it is believed to stand.
    fn parts(&self, request: &Request) -> Vec<Obstacle> {
        let palm = self.mechanism.arm.palm(&request.start.map(|state| state.position));
        let held = request.held.map(|(kind, in_palm)| (kind, palm * in_palm));
        let near = |kind: usize, other: &Option<(usize, Isometry3<f64>)>, frame: &Isometry3<f64>| {
            other.as_ref().is_some_and(|(same, place)| {
                *same == kind && (place.translation.vector - frame.translation.vector).norm() < SAME
            })
        };
        let person = request.person.map(|arm| arm.after(0.0));
        let meant = request.kind.filter(|_| request.errand == Errand::Take).map(|kind| (kind, request.frame));
        let mut parts = Vec::new();
        for (index, sighting) in request.parts[..request.seen].iter().enumerate() {
            let kind = sighting.kind as usize;
            let [x, y, z, w] = sighting.orientation;
            let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-3);
            let (Some(turn), Some(shape)) = (turn, self.shapes.get(kind)) else { continue };
            let frame = Isometry3::from_parts(Translation3::from(sighting.position), turn);
            let at = Point3::from(frame.translation.vector);
            let carried = person.iter().flatten().any(|arm| arm.distance_of_line(&at) < arm.radius + IN_HAND);
            let received = request.errand == Errand::Receive && request.kind == Some(kind);
            let awaited = received && request.before;
            if !frame.translation.vector.iter().all(|value| value.is_finite())
                || near(kind, &held, &frame)
                || (carried && !awaited && !near(kind, &meant, &frame))
                || (received && !awaited && near(kind, &Some((kind, request.frame)), &frame))
            {
                continue;
            }
            let frame = if near(kind, &meant, &frame) { request.frame } else { frame };
            parts.push(workplace::upright(&format!("part {index}"), *shape, &frame));
        }
        parts
    }

    /// Names of what the hand may touch where it works: what lies near the place that it leaves, and near the one where
    /// it puts something.
    fn touchable(&self, request: &Request, offers: &[Offer], obstacles: &[Obstacle]) -> Vec<String> {
        let mut names = vec![PERSON.to_owned()];
        let start = request.start.map(|state| state.position);
        let mut places: Vec<Point3<f64>> = Vec::new();
        if request.leave.is_some() {
            places.push(self.mechanism.arm.palm(&start) * self.mechanism.grasp_point());
        }
        if matches!(request.errand, Errand::Place | Errand::PutBack | Errand::Steady) {
            places.extend(offers.first().map(|(goal, _)| goal.point));
        }
        let holds = request.held.is_some() && !places.is_empty();
        let works = matches!(request.errand, Errand::Place | Errand::Steady) || request.leave.is_some();
        names.extend(
            [(Fixture::TABLE, holds), (Fixture::PLATFORM, works)]
                .iter()
                .filter(|(_, may)| *may)
                .map(|(name, _)| (*name).to_owned()),
        );
        let parts = obstacles.iter().filter(|obstacle| obstacle.name.starts_with("part "));
        let near = parts.filter(|part| {
            places.iter().any(|place| part.hull.distance_of_line(place) - part.hull.radius < NEIGHBOURS)
        });
        names.extend(near.map(|part| part.name.clone()));
        names
    }
}

/// The person's arm now and a moment from now; only the upper arm when hand and hand shall meet.
fn person(arm: &PersonArm, meets: bool) -> Vec<Obstacle> {
    let count = if meets { 1 } else { 3 };
    let capsules = [0.0, AHEAD].into_iter().flat_map(|ahead| arm.after(ahead).into_iter().take(count));
    capsules.map(|capsule| Obstacle::new(PERSON, Solid::Capsule(capsule), &Isometry3::identity())).collect()
}
