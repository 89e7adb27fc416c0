use super::planning_scene::PERSON;
use super::{HandGoals, PlanningQuery, PlanningResult, PlanningScene};
use crate::robot::{CollisionModels, FingerShape, GripGoal, RobotModel};
use crate::state::{ArmTrajectory, Skill};
use coact_joint_task::Task;
use coact_motion::{
    CollisionModel, Goal, HandSpeedLimits, MinClearance, Plan, Problem, Refusal, Scene, SearchHeartbeat,
    shortest_time,
};
use coact_robot::{HandGoal, MotionState, RobotError};
use coact_safety::{PlannerLimits, SafetyLimits};
use coact_stage_state::Flag;
use nalgebra::{Translation3, Vector3};

/// Answers control's queries for movements, among all that is known of the surroundings. It allocates and takes
/// milliseconds: it works beside the servo, never in its cycle.
#[derive(Debug)]
pub(crate) struct SkillPlanner {
    robot: RobotModel,
    models: CollisionModels,
    goals: HandGoals,
    scene: PlanningScene,
    limits: PlannerLimits,
    hand_speeds: HandSpeedLimits,
    heartbeat: SearchHeartbeat,
}

/// Postures that a search looks at when the arm is in motion, and when it stands: in motion the answer must come within the
/// lead, at rest before the person wonders what the robot waits for.
const SEARCH_IN_MOTION: u32 = 1_000;
const SEARCH_AT_REST: u32 = 4_000;
/// The same where the person waits for the hand: a movement that is found late is better than a hand that goes as far as it
/// can and stops there.
const SEARCH_FOR_PERSON: u32 = 10_000;
/// How much longer than joints from rest would need, with nothing in the way, a movement from motion may take, s: of 93, 26 took
/// longer, for they turn round first, and the search for them is short; of 282 from rest 25. To stop takes 0.1 s.
const ROUNDABOUT_S: f64 = 1.1;
/// How much of a part fingers leave free for what it goes into, and the least length on which the hand puts a part down, or
/// comes to the base that it steadies, along a straight line, m. Sockets that are deeper, or axles that stick out farther, ask for
/// more of the latter.
pub(crate) const INSERTION_DEPTH: f64 = 0.03;
/// Least speed at which the hand comes to something, m/s: however little contact is allowed to hurt, parts are to be taken. Chosen by hand.
const SLOWEST_CONTACT: f64 = 0.05;
/// Fraction of a withdrawal that is a straight line: the rest rounds the corner to its end.
const STRAIGHT_WITHDRAWAL: f64 = 0.9;

/// One way of looking for a movement.
struct Attempt<'a> {
    model: &'a CollisionModel,
    scene: &'a Scene,
    leave: Option<(Vector3<f64>, f64)>,
}

impl SkillPlanner {
    pub fn new(
        robot: RobotModel,
        mut models: CollisionModels,
        goals: HandGoals,
        task: &Task,
        limits: SafetyLimits,
    ) -> Self {
        // Its own: the guard, which has the same mechanism, works in the cycle of who watches this one.
        let heartbeat = SearchHeartbeat::default();
        models.mechanism = models.mechanism.beating(heartbeat.clone());
        let scene = PlanningScene::new(&robot, &models, task, limits);
        let SafetyLimits { planner, guard, .. } = limits;
        let comfort = planner.comfort.fraction();
        let contact = guard.contact_speed.clamp(SLOWEST_CONTACT, planner.hand_speed);
        let hand_speeds = HandSpeedLimits { free: comfort * planner.hand_speed, contact: comfort * contact };
        Self { robot, models, goals, scene, limits: planner, hand_speeds, heartbeat }
    }

    /// Beats while it searches.
    pub fn heartbeat(&self) -> &SearchHeartbeat {
        &self.heartbeat
    }

    /// Whether the arm can get to one of these goals when nothing is in the way.
    ///
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn reaches(&self, goals: Vec<HandGoal>) -> Result<bool, RobotError> {
        let fingers = self.robot.hand_angles(FingerShape::Slender);
        let (model, scene) = (self.models.of(&[fingers], None)?, Scene::default());
        let park = self.models.mechanism.park;
        let problem = self.problem(&model, &scene, park.map(MotionState::at_rest), Goal::Hand(goals));
        Ok(!problem.targets_from(&park).is_empty())
    }

    /// The movement that is asked for, one that only withdraws the hand, or none.
    pub fn plan(&mut self, query: &PlanningQuery) -> PlanningResult {
        self.movement(query).unwrap_or(PlanningResult::REFUSED)
    }

    /// From a person who is near the hand withdraws first, and then keeps its distance. Where the person leaves no path, the arm goes as far as the guard
    /// lets it, but not to where the person comes; where there is no room for the fingers to move with the arm, they move when
    /// it has arrived.
    fn movement(&self, query: &PlanningQuery) -> Option<PlanningResult> {
        let (moving, still) = self.models_of(query).ok()?;
        let goals = self.goals.of(query);
        let person = self.scene.person(query, &self.goals);
        let (separation, away) = self.scene.separation(query, &still, &person);
        let alone = self.scene.without_person(query, &still, &goals);
        let clear_of = |beyond, separation| alone.with(self.scene.inflated(&person, separation, beyond));
        let withdrawing = |beyond| {
            let mut scene = clear_of(beyond, f64::INFINITY);
            scene.allowed_leaving.push(PERSON.to_owned());
            scene
        };
        // As far from the person as the guard lets the arm go on at its own speed; and just as far as it asks for.
        let distances = [self.limits.beyond_guard, 0.0];
        let [wide, close] = distances.map(|beyond| clear_of(beyond, separation));
        let (moves, awaits, leave) = (query.is_in_motion(), query.awaits_person(), query.leave);
        let is_near = separation < self.limits.withdraw_within && !moves;
        let out = if is_near { Vec::from(distances.map(withdrawing)) } else { Vec::new() };
        let leave_out = leave.or(Some((away, self.limits.withdraw_distance)));
        let last = if awaits { &close } else { &alone };
        let withdrawn = out.iter().map(|scene| Attempt { model: &moving, scene, leave: leave_out });
        let kept_clear = [&wide, &close].map(|scene| Attempt { model: &moving, scene, leave });
        let unhindered = (!awaits).then_some(Attempt { model: &moving, scene: &alone, leave });
        let fingers_still = (!moves).then_some(Attempt { model: &still, scene: last, leave });
        for attempt in withdrawn.chain(kept_clear).chain(unhindered).chain(fingers_still) {
            if let Ok(plan) = self.search(query, &attempt, &goals) {
                if moves && self.is_roundabout(query, &plan) {
                    return None;
                }
                let fingers_wait = std::ptr::eq(attempt.model, &still);
                return Some(result(&plan, &goals, fingers_wait));
            }
        }
        if moves { None } else { self.withdrawal(query, &still, &close) }
    }

    /// Arm and hand with fingers that take their shape for the goal on the way, and with fingers that stand still.
    fn models_of(&self, query: &PlanningQuery) -> Result<(CollisionModel, CollisionModel), RobotError> {
        let shape = self.robot.on_the_way(query.skill, query.kind, query.held_in);
        let passed = [query.fingers, query.finger_target, self.robot.hand_angles(shape)];
        Ok((self.models.of(&passed, query.held)?, self.models.of(&passed[..1], query.held)?))
    }

    fn search(&self, query: &PlanningQuery, attempt: &Attempt, goals: &[GripGoal]) -> Result<Plan, Refusal> {
        let goal = match query.skill {
            Skill::Park => Goal::Posture(self.models.mechanism.park),
            _ => Goal::Hand(goals.iter().map(|grip_goal| grip_goal.goal).collect()),
        };
        let insertion_depth = match query.skill {
            Skill::Insert => INSERTION_DEPTH.max(self.goals.insertion_depth(&query.place)),
            Skill::PutBack | Skill::Steady => INSERTION_DEPTH,
            _ => 0.0,
        };
        let next = query.next_place.map(|next| next * query.place.inverse());
        let problem = self.problem(attempt.model, attempt.scene, query.start, goal);
        let problem = Problem {
            leave: attempt.leave,
            next_displacements: next.into_iter().collect(),
            insertion_depth,
            min_clearance: MinClearance { goal: self.goal_clearance(query.skill), ..problem.min_clearance },
            ..problem
        };
        problem.plan_within(match query.is_in_motion() {
            true => SEARCH_IN_MOTION,
            false if query.awaits_person() => SEARCH_FOR_PERSON,
            false => SEARCH_AT_REST,
        })
    }

    /// Whether a movement of an arm under way takes so long that the arm had better stop and set out anew.
    fn is_roundabout(&self, query: &PlanningQuery, plan: &Plan) -> bool {
        let from = query.start.map(|state| MotionState::at_rest(state.position));
        let to = plan.at(plan.duration()).map(|state| state.position);
        plan.duration() > shortest_time(&from, &to, &self.models.mechanism.limits()) + ROUNDABOUT_S
    }

    /// Straight back out of a place that no movement leaves, or up. The hand may touch, on its way out, whatever it stands too
    /// near to.
    fn withdrawal(
        &self,
        query: &PlanningQuery,
        model: &CollisionModel,
        scene: &Scene,
    ) -> Option<PlanningResult> {
        let palm = self.models.mechanism.arm.palm(&query.start.map(|state| state.position));
        let back = palm.rotation * -Vector3::z();
        let min_clearance = MinClearance { path: 0.0, goal: 0.0 };
        let names = scene.obstacles.iter().map(|obstacle| obstacle.name.as_str());
        let scene = &scene.touching(&names.collect::<Vec<_>>());
        let distance = self.limits.withdraw_distance;
        let withdrawal = [back, Vector3::z()].iter().find_map(|direction| {
            let away = Translation3::from(direction * distance) * palm;
            let goal = self.goals.palm_at(&away, 0.0);
            let problem = self.problem(model, scene, query.start, Goal::Hand(vec![goal]));
            let leave = Some((*direction, STRAIGHT_WITHDRAWAL * distance));
            Problem { leave, min_clearance, ..problem }.plan().ok()
        });
        let mut trajectory = withdrawal.as_ref().and_then(ArmTrajectory::of)?;
        trajectory.withdraws = Flag::Set;
        Some(PlanningResult { trajectory: Some(trajectory), grip: None })
    }

    fn problem<'a>(
        &'a self,
        collision_model: &'a CollisionModel,
        scene: &'a Scene,
        start: [MotionState; 7],
        goal: Goal,
    ) -> Problem<'a> {
        let PlannerLimits { path_clearance, goal_clearance, .. } = self.limits;
        let problem = Problem::new(&self.models.mechanism, collision_model, scene, start, goal);
        let min_clearance = MinClearance { path: path_clearance, goal: goal_clearance };
        Problem { min_clearance, hand_speeds: self.hand_speeds, ..problem }
    }

    fn goal_clearance(&self, skill: Skill) -> f64 {
        if skill == Skill::Insert { self.limits.insertion_clearance } else { self.limits.goal_clearance }
    }
}

/// A plan as the answer to a query. With `fingers_wait`, the fingers take their shape at its end.
fn result(plan: &Plan, goals: &[GripGoal], fingers_wait: bool) -> PlanningResult {
    let grip = plan.target.and_then(|target| goals.get(target.goal)?.grip);
    let mut trajectory = ArmTrajectory::of(plan);
    if let Some(trajectory) = trajectory.as_mut().filter(|_| fingers_wait) {
        trajectory.fingers_begin = trajectory.duration();
    }
    PlanningResult { trajectory, grip }
}
