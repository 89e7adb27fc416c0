use crate::answer::Answer;
use crate::body::{Body, Fingers};
use crate::course::Course;
use crate::errand::Errand;
use crate::places::{Offer, Places};
use crate::request::Request;
use crate::surroundings;
use coact_joint_task::{Shape, Task};
use coact_motion::{Goal, Mechanism, MinClearance, Obstacle, Plan, Problem, Refusal, Scene};
use coact_robot::{HAND_JOINTS, HandGoal, MotionState, RobotError};
use nalgebra::{Isometry3, Translation3, Vector3};

/// Answers control's questions for movements, among all that is known of the surroundings. Allocates and takes
/// milliseconds: it works beside the servo, never in its cycle.
#[derive(Debug)]
pub(crate) struct Planner {
    pub(crate) body: Body,
    pub(crate) mechanism: Mechanism,
    pub(crate) places: Places,
    pub(crate) shapes: Vec<Shape>,
    pub(crate) fixtures: Vec<Obstacle>,
}

/// Distances that are kept: fingers around something low stand hardly higher than what it lies on.
pub(crate) const MARGIN: MinClearance = MinClearance { path: 0.01, goal: 0.001 };
/// Postures that a search looks at, in motion and at rest: it ends before the person wonders.
const EFFORT: (u32, u32) = (1_000, 4_000);
/// And where the person waits for the hand, which shall not go as far as it can and stop there.
const PATIENT: u32 = 10_000;
/// How deep parts go into their places at most, m.
pub(crate) const GUIDE: f64 = 0.03;
/// A person nearer than this to a hand at rest is one from whom it gets away first, m.
const NEAR: f64 = 0.10;
/// How far the hand gets out of a place from which no movement was found, m.
const WITHDRAWAL: f64 = 0.08;

impl Planner {
    pub fn new(body: Body, places: Places, task: &Task) -> Result<Self, RobotError> {
        Ok(Self {
            mechanism: Mechanism::of(&body.robot)?,
            places,
            shapes: task.kinds.iter().map(|kind| kind.shape).collect(),
            fixtures: coact_workplace::fixtures(task),
            body,
        })
    }

    /// Arm and hand whose fingers pass through these shapes (angles, rad), around or on what is held.
    pub fn figure(
        &self,
        fingers: &[[f64; HAND_JOINTS]],
        held: Option<(usize, Isometry3<f64>)>,
    ) -> Result<coact_motion::CollisionModel, RobotError> {
        let figure = self.mechanism.with_moving_fingers(&self.body.robot.hand, fingers)?;
        Ok(match held {
            None => figure,
            Some((kind, in_palm)) => {
                let (solid, centre) = coact_workplace::solid(self.shapes[kind]);
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
        let problem = self.problem(&body, &scene, start, Goal::Hand(goals));
        Ok(!problem.targets_from(&self.mechanism.park).is_empty())
    }

    /// The movement that is asked for, one that only gets the hand free, or none.
    pub fn answer(&mut self, request: &Request) -> Answer {
        let refused = Answer { id: request.id, course: None, hold: None, withdraws: false };
        let wanted = self.body.on_the_way(request.errand, request.kind, request.hold);
        let offers = self.places.goals(request);
        let passed = [request.fingers, request.heading, self.body.fingers(wanted)];
        let Ok(moving) = self.figure(&passed, request.held) else { return refused };
        let Ok(still) = self.figure(&passed[..1], request.held) else { return refused };
        let person = self.person(request);
        let (gap, away) = self.gap(request, &still, &person);
        let alone = self.scene(request, &offers);
        let scene = alone.with(surroundings::stout(&person, gap));
        let (moves, awaits) = (request.is_in_motion(), request.awaits());
        let is_near = gap < NEAR && request.leave.is_none() && !moves;
        let from_person = Scene { allowed_leaving: vec![surroundings::PERSON.to_owned()], ..scene.clone() };
        // From a person who is near the hand gets away first. Where the person leaves no way, the arm goes as far as the
        // guard lets it, but not to where the person comes; where there is no room for the fingers to move with the arm, they
        // move when it has arrived.
        let attempts = [
            (is_near, &moving, &from_person, Some((away, WITHDRAWAL))),
            (true, &moving, &scene, request.leave),
            (!awaits, &moving, &alone, request.leave),
            (!moves, &still, if awaits { &scene } else { &alone }, request.leave),
        ];
        for (_, figure, scene, leave) in attempts.into_iter().filter(|attempt| attempt.0) {
            if let Ok(plan) = self.plan(&Request { leave, ..*request }, figure, scene, &offers) {
                let hold = plan.target.and_then(|target| offers.get(target.goal)?.1);
                let mut course = Course::of(&plan);
                if let Some(course) = course.as_mut().filter(|_| std::ptr::eq(figure, &still)) {
                    course.preshapes = course.duration();
                }
                return Answer { course, hold, ..refused };
            }
        }
        if moves {
            return refused;
        }
        let withdrawn = self.withdraw(request, &still, &scene);
        Answer { course: withdrawn.as_ref().and_then(Course::of), withdraws: true, ..refused }
    }

    fn plan(
        &self,
        request: &Request,
        figure: &coact_motion::CollisionModel,
        scene: &Scene,
        offers: &[Offer],
    ) -> Result<Plan, Refusal> {
        let goal = match request.errand {
            Errand::Park => Goal::Posture(self.mechanism.park),
            _ => Goal::Hand(offers.iter().map(|(goal, _)| *goal).collect()),
        };
        let puts = matches!(request.errand, Errand::Place | Errand::PutBack);
        let guide = if puts { GUIDE } else { 0.0 };
        let then = request.next.map(|next| next * request.frame.inverse()).into_iter().collect();
        let problem = self.problem(figure, scene, request.start, goal);
        let problem =
            Problem { leave: request.leave, next_displacements: then, insertion_depth: guide, ..problem };
        problem.plan_within(match request.is_in_motion() {
            true => EFFORT.0,
            false if request.awaits() => PATIENT,
            false => EFFORT.1,
        })
    }

    /// Straight back out of a place that no movement leaves, or up.
    fn withdraw(
        &self,
        request: &Request,
        figure: &coact_motion::CollisionModel,
        scene: &Scene,
    ) -> Option<Plan> {
        let palm = self.mechanism.arm.palm(&request.start.map(|state| state.position));
        let back = palm.rotation * -Vector3::z();
        let min_clearance = MinClearance { path: 0.0, goal: 0.0 };
        // The hand may touch, on its way out, whatever it stands too near to.
        let names = scene.obstacles.iter().map(|obstacle| obstacle.name.as_str());
        let scene = &scene.touching(&names.collect::<Vec<_>>());
        [back, Vector3::z()].iter().find_map(|direction| {
            let away = Translation3::from(direction * WITHDRAWAL) * palm;
            let goal = self.places.palm_at(&away, 0.0);
            let problem = self.problem(figure, scene, request.start, Goal::Hand(vec![goal]));
            Problem { leave: Some((*direction, 0.9 * WITHDRAWAL)), min_clearance, ..problem }.plan().ok()
        })
    }

    fn problem<'a>(
        &'a self,
        collision_model: &'a coact_motion::CollisionModel,
        scene: &'a Scene,
        start: [MotionState; 7],
        goal: Goal,
    ) -> Problem<'a> {
        let mechanism = &self.mechanism;
        Problem {
            mechanism,
            collision_model,
            scene,
            start,
            leave: None,
            goal,
            next_displacements: Vec::new(),
            insertion_depth: 0.0,
            min_clearance: MARGIN,
        }
    }
}
