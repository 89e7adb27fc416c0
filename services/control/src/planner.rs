use crate::answer::Answer;
use crate::body::{Body, Fingers};
use crate::course::Course;
use crate::errand::Errand;
use crate::guard;
use crate::places::{Offer, Places};
use crate::request::Request;
use crate::senses::frame_of;
use coact_joint_task::{Fixture, Shape, Task};
use coact_motion::{
    Aim, Capsule, Margin, Mechanism, Obstacle, Plan, Problem, Refusal, Scene, Solid, workplace,
};
use coact_robot::{HAND_JOINTS, HandGoal, MotionState, RobotError};
use nalgebra::{Isometry3, Point3, Translation3, Vector3};

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
/// How far ahead the person's arm is kept clear of as well, s.
const AHEAD: f64 = 0.3;
/// By how much more than the guard a plan keeps clear of the person, m.
const FROM_GUARD: f64 = 0.005;
/// A person nearer than this to a hand at rest is one from whom it gets away first, m.
const NEAR: f64 = 0.10;
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

    /// Arm and hand whose fingers pass through these shapes (angles, rad), around or on what is held.
    pub fn figure(
        &self,
        fingers: &[[f64; HAND_JOINTS]],
        held: Option<(usize, Isometry3<f64>)>,
    ) -> Result<coact_motion::Body, RobotError> {
        let figure = self.mechanism.with_moving_fingers(&self.body.robot.hand, fingers)?;
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
        let (body, scene) = (self.figure(&[self.body.fingers(Fingers::Slender)], None)?, Scene::default());
        let start = self.mechanism.park.map(MotionState::at_rest);
        let problem = self.problem(&body, &scene, start, Aim::Hand(goals));
        Ok(!problem.targets_from(&self.mechanism.park).is_empty())
    }

    /// The movement that is asked for, one that only gets the hand free, or none.
    pub fn answer(&mut self, request: &Request) -> Answer {
        let refused = Answer { id: request.id, course: None, hold: None, withdraws: false };
        let wanted = self.body.on_the_way(request.errand, request.kind, request.hold);
        let offers = self.places.goals(request);
        let person = self.person(request);
        let (gap, away) = self.gap(request, &person);
        let alone = self.scene(request, &offers);
        let scene = alone.with(stout(&person, gap));
        let is_near = gap < NEAR && request.leave.is_none() && !request.is_in_motion();
        let from_person = Scene { left: vec![PERSON.to_owned()], ..scene.clone() };
        let passed = [request.fingers, request.heading, self.body.fingers(wanted)];
        // From a person who is near the hand gets away first. Where the person leaves no way, the arm goes as far as the
        // guard lets it; where there is no room for the fingers to move with the arm, they move when it has arrived.
        let attempts = [
            (&passed[..], &from_person, Some((away, WITHDRAWAL))),
            (&passed, &scene, request.leave),
            (&passed, &alone, request.leave),
            (&passed[..1], &alone, request.leave),
        ];
        for (shapes, scene, leave) in attempts.into_iter().skip(usize::from(!is_near)) {
            let Ok(figure) = self.figure(shapes, request.held) else { return refused };
            if let Ok(plan) = self.plan(&Request { leave, ..*request }, &figure, scene, &offers) {
                let hold = plan.target.and_then(|target| offers.get(target.goal)?.1);
                let mut course = Course::of(&plan);
                if let Some(course) = course.as_mut().filter(|_| shapes.len() == 1) {
                    course.preshapes = course.duration();
                }
                return Answer { course, hold, ..refused };
            }
        }
        if request.is_in_motion() {
            return refused;
        }
        let Ok(figure) = self.figure(&[request.fingers], request.held) else { return refused };
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

    /// All that the arm keeps clear of now, besides the person.
    fn scene(&self, request: &Request, offers: &[Offer]) -> Scene {
        let mut obstacles = self.fixtures.clone();
        obstacles.extend(self.parts(request));
        for [x, y, z, half_x, half_y, half_z] in &request.screens[..request.screened] {
            let edges = 2.0 * Vector3::new(*half_x, *half_y, *half_z);
            obstacles.push(Obstacle::new("screen", Solid::Box(edges), &Isometry3::translation(*x, *y, *z)));
        }
        let (left, sought) = (self.left(request, &obstacles), self.sought(request, offers, &obstacles));
        Scene { obstacles, left, sought }
    }

    /// The person's arm now, a moment from now and where it will bring a part; only the upper arm when the robot takes
    /// something from the hand.
    fn person(&self, request: &Request) -> Vec<Capsule> {
        let Some(arm) = request.person else { return Vec::new() };
        let count = if request.errand == Errand::Receive && !request.before { 1 } else { usize::MAX };
        let awaits = request.errand == Errand::Ask || (request.errand == Errand::Receive && request.before);
        let hull = request.kind.filter(|_| awaits).and_then(|kind| self.body.hulls.get(kind));
        let coming = hull.map(|hull| self.places.coming(hull)).into_iter().flatten();
        [0.0, AHEAD].into_iter().flat_map(|ahead| arm.after(ahead).take(count)).chain(coming).collect()
    }

    /// Distance of arm, hand and held part from the person, m, and the direction away from there.
    fn gap(&self, request: &Request, person: &[Capsule]) -> (f64, Vector3<f64>) {
        let start = request.start.map(|state| state.position);
        let figure = self.figure(&[request.fingers], request.held).ok();
        let hulls = figure.map_or_else(Vec::new, |figure| figure.moving_hulls(&self.mechanism, &start));
        let pairs = hulls.iter().flat_map(|hull| person.iter().map(move |capsule| (hull, capsule)));
        let gaps = pairs.map(|(hull, capsule)| (hull.distance(capsule), hull.nearest(capsule)));
        let nearest = gaps.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.map_or((f64::INFINITY, Vector3::z()), |(gap, (mine, theirs))| {
            (gap, (mine - theirs).try_normalize(1e-6).unwrap_or_else(Vector3::z))
        })
    }

    /// The parts in sight, but for what is, or is about to come, into a hand; the one that is meant stands where it is believed to stand.
    fn parts(&self, request: &Request) -> Vec<Obstacle> {
        let palm = self.mechanism.arm.palm(&request.start.map(|state| state.position));
        let held = request.held.map(|(kind, in_palm)| (kind, palm * in_palm));
        let near = |kind: usize, other: &Option<(usize, Isometry3<f64>)>, frame: &Isometry3<f64>| {
            other.as_ref().is_some_and(|(same, place)| {
                *same == kind && (place.translation.vector - frame.translation.vector).norm() < SAME
            })
        };
        let in_person_hand = request.person.and_then(|arm| arm.held());
        let meant = request.kind.filter(|_| request.errand == Errand::Take).map(|kind| (kind, request.frame));
        let received = request.kind.filter(|_| request.errand == Errand::Receive && !request.before);
        let received = received.map(|kind| (kind, request.frame));
        let mut parts = Vec::new();
        for (index, sighting) in request.parts[..request.seen].iter().enumerate() {
            let kind = sighting.kind as usize;
            let (Some(frame), Some(shape)) = (frame_of(sighting), self.shapes.get(kind)) else { continue };
            if in_person_hand == Some(index) || near(kind, &held, &frame) || near(kind, &received, &frame) {
                continue;
            }
            let frame = if near(kind, &meant, &frame) { request.frame } else { frame };
            parts.push(workplace::upright(&format!("part {index}"), *shape, &frame));
        }
        parts
    }

    /// What the hand may touch where it leaves: what lies around it, and what it stands on.
    fn left(&self, request: &Request, obstacles: &[Obstacle]) -> Vec<String> {
        if request.leave.is_none() {
            return Vec::new();
        }
        let palm = self.mechanism.arm.palm(&request.start.map(|state| state.position));
        let lifts = request.held.map(|_| Fixture::TABLE);
        let ground = [PERSON, Fixture::PLATFORM].into_iter().chain(lifts);
        ground.map(str::to_owned).chain(around(&(palm * self.mechanism.grasp_point()), obstacles)).collect()
    }

    /// What it may touch at the goal.
    fn sought(&self, request: &Request, offers: &[Offer], obstacles: &[Obstacle]) -> Vec<String> {
        let ground = match request.errand {
            Errand::Offer => return vec![PERSON.to_owned()],
            Errand::Place | Errand::Steady => Fixture::PLATFORM,
            Errand::PutBack => Fixture::TABLE,
            _ => return Vec::new(),
        };
        let place = offers.first().map(|(goal, _)| goal.point);
        let near = place.into_iter().flat_map(|place| around(&place, obstacles));
        std::iter::once(ground.to_owned()).chain(near).collect()
    }
}

/// The person as obstacles as stout as the guard keeps clear of them, or as this gap leaves room for.
fn stout(person: &[Capsule], gap: f64) -> impl Iterator<Item = Obstacle> {
    let stouter = (gap - MARGIN.goal).clamp(0.0, guard::MARGIN + FROM_GUARD - MARGIN.way);
    let stout = person.iter().map(move |part| Capsule { radius: part.radius + stouter, ..*part });
    stout.map(|part| Obstacle::moving(PERSON, part))
}

/// Names of the parts that lie near a place.
fn around(place: &Point3<f64>, obstacles: &[Obstacle]) -> Vec<String> {
    let parts = obstacles.iter().filter(|obstacle| obstacle.name.starts_with("part "));
    let near = parts.filter(|part| part.hull.distance_of_line(place) - part.hull.radius < NEIGHBOURS);
    near.map(|part| part.name.clone()).collect()
}
