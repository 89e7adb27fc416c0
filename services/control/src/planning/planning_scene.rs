use super::{HandGoals, PlanningQuery};
use crate::robot::{CollisionModels, GripGoal, RobotModel};
use crate::state::Skill;
use coact_joint_task::{Fixture, Shape, Task};
use coact_motion::{Capsule, CollisionModel, Mechanism, Obstacle, Scene, Solid};
use coact_safety::SafetyLimits;
use coact_seen_parts::frame_of;
use nalgebra::{Isometry3, Point3, Vector3};

/// What the arm keeps clear of on its way, and what the hand may touch.
#[derive(Debug)]
pub(crate) struct PlanningScene {
    mechanism: Mechanism,
    /// Shapes, and bounding capsules, of the kinds of parts.
    shapes: Vec<Shape>,
    part_capsules: Vec<Capsule>,
    fixtures: Vec<Obstacle>,
    limits: SafetyLimits,
}

/// Name of the person's arm among the obstacles.
pub(crate) const PERSON: &str = "person";
/// Name of the part that the person is about to mount among the obstacles.
const AWAITED: &str = "awaited part";
/// What the names of parts among the obstacles begin with.
const PART: &str = "part ";
/// What is nearer than this to where the hand works may be touched by it there, m: the width of a finger and some, for the
/// fingers reach that far beyond what they grasp. Chosen by hand.
const NEIGHBOURS: f64 = 0.04;
/// The part that is meant is this much wider to the planner than it is, m: open fingers come down 10 mm beside it, by an estimate
/// of its place that scatters by a millimetre or two. Chosen by hand: with a millimetre of clearance alone, a finger struck the
/// upper edge of one in some three hundred parts.
const ESTIMATE_ERROR: f64 = 0.004;
/// A part of the same kind this near to where one is meant is that one, m: parts of a kind lie farther apart, and a part that
/// is pushed by the hand is seen this near. Chosen by hand.
const SAME: f64 = 0.06;

impl PlanningScene {
    pub fn new(model: &RobotModel, models: &CollisionModels, task: &Task, limits: SafetyLimits) -> Self {
        Self {
            mechanism: models.mechanism.clone(),
            shapes: models.shapes.clone(),
            part_capsules: model.part_capsules.clone(),
            fixtures: coact_workplace::fixtures(task),
            limits,
        }
    }

    /// All that the arm keeps clear of now, besides the person.
    pub fn without_person(&self, query: &PlanningQuery, model: &CollisionModel, goals: &[GripGoal]) -> Scene {
        let mut obstacles = self.fixtures.clone();
        obstacles.extend(self.parts(query));
        obstacles.extend(self.awaited(query));
        for [x, y, z, half_x, half_y, half_z] in query.surroundings.obstacles() {
            let edges = 2.0 * Vector3::new(*half_x, *half_y, *half_z);
            obstacles.push(Obstacle::new("obstacle", Solid::Box(edges), &Isometry3::translation(*x, *y, *z)));
        }
        let allowed_leaving = self.allowed_leaving(query, model, &obstacles);
        let allowed_at_goal = allowed_at_goal(query, goals, &obstacles);
        Scene { obstacles, allowed_leaving, allowed_at_goal }
    }

    /// The person's arms now, a moment from now and where a part will be brought, or mounted while the base is steadied; of the acting one only the upper arm when the robot
    /// receives something from its hand.
    pub fn person(&self, query: &PlanningQuery, goals: &HandGoals) -> Vec<Capsule> {
        let Some(person) = query.person else { return Vec::new() };
        let count = if query.receives() { 1 } else { usize::MAX };
        let awaited = query.kind.filter(|_| query.awaits_person());
        let part = awaited.and_then(|kind| self.part_capsules.get(kind));
        let coming = part.map(|part| goals.coming(part, &self.limits.person)).into_iter().flatten();
        let works = (query.skill == Skill::Steady).then(|| goals.working(&query.place, &self.limits.person));
        let ahead = self.limits.planner.person_ahead.as_secs_f64();
        let arms = |ahead| person.acting_after(ahead).take(count).chain(person.other_after(ahead));
        [0.0, ahead].into_iter().flat_map(arms).chain(coming).chain(works).collect()
    }

    /// Distance of arm, hand and held part from the person, m, and the direction away from there.
    pub fn separation(
        &self,
        query: &PlanningQuery,
        model: &CollisionModel,
        person: &[Capsule],
    ) -> (f64, Vector3<f64>) {
        let links = self.links(query, model);
        let pairs = links.iter().flat_map(|link| person.iter().map(move |limb| (link, limb)));
        let gaps = pairs.map(|(link, limb)| (link.distance(limb), link.nearest(limb)));
        let nearest = gaps.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.map_or((f64::INFINITY, Vector3::z()), |(gap, (own, theirs))| {
            (gap, (own - theirs).try_normalize(1e-6).unwrap_or_else(Vector3::z))
        })
    }

    /// Capsules around arm, hand and held part where the movement begins.
    fn links(&self, query: &PlanningQuery, model: &CollisionModel) -> Vec<Capsule> {
        let mut links = Vec::new();
        model.moving_bounding_capsules(&self.mechanism, &query.start.map(|state| state.position), &mut links);
        links
    }

    /// The person as obstacles, inflated so that paths and goals keep so much farther away than the guard's protective separation; by
    /// less where the person is nearer than that already.
    pub fn inflated(
        &self,
        person: &[Capsule],
        separation: f64,
        beyond_guard: f64,
    ) -> impl Iterator<Item = Obstacle> {
        let SafetyLimits { guard, planner, .. } = self.limits;
        let most = guard.protective_separation + beyond_guard - planner.goal_clearance;
        let by = (separation - planner.goal_clearance).clamp(0.0, most);
        let inflated = person.iter().map(move |limb| Capsule { radius: limb.radius + by, ..*limb });
        inflated.map(|limb| Obstacle::moving(PERSON, limb))
    }

    /// The parts, but for what is in a hand or about to come into the robot's; the one that is meant stands where it
    /// is believed to stand.
    fn parts(&self, query: &PlanningQuery) -> Vec<Obstacle> {
        let palm = self.mechanism.arm.palm(&query.start.map(|state| state.position));
        let held = query.held.map(|(kind, in_palm)| (kind, palm * in_palm));
        let meant = query.kind.filter(|_| query.skill == Skill::Pick).map(|kind| (kind, query.place));
        let received = query.kind.filter(|_| query.receives()).map(|kind| (kind, query.place));
        let in_person_hand = query.person.and_then(|person| person.held());
        let mut parts = Vec::new();
        for (index, sighting) in query.surroundings.parts.all().iter().enumerate() {
            let kind = sighting.kind as usize;
            let (Some(frame), Some(shape)) = (frame_of(sighting), self.shapes.get(kind)) else { continue };
            let is = |other: &Option<(usize, Isometry3<f64>)>| is_same(kind, &frame, other.as_ref());
            if in_person_hand == Some(index) || is(&held) || is(&received) {
                continue;
            }
            let (frame, shape) =
                if is(&meant) { (query.place, shape.widened(ESTIMATE_ERROR)) } else { (frame, *shape) };
            parts.push(coact_workplace::upright(&format!("{PART}{index}"), shape, &frame));
        }
        parts
    }

    /// The part that the person mounts while the robot steadies the base, where it will be: a hand that stood there would be pushed
    /// aside by it.
    fn awaited(&self, query: &PlanningQuery) -> Option<Obstacle> {
        let kind = query.kind.filter(|_| query.skill == Skill::Steady)?;
        Some(coact_workplace::upright(AWAITED, *self.shapes.get(kind)?, &query.place))
    }

    /// What the hand may touch where it leaves: what lies around it, what it stands on, and parts that seem to touch it: beside parts that lie
    /// close together the scatter of their estimates is more than the clearance with which it came there, and it would never leave again. A
    /// hand that is still coming does not stand there yet: it would turn round within the base.
    fn allowed_leaving(
        &self,
        query: &PlanningQuery,
        model: &CollisionModel,
        obstacles: &[Obstacle],
    ) -> Vec<String> {
        if query.leave.is_none() {
            return Vec::new();
        }
        let palm = self.mechanism.arm.palm(&query.start.map(|state| state.position));
        let lifts_from = query.held.map(|_| Fixture::TABLE);
        let stands_on = (!query.is_in_motion()).then_some(Fixture::PLATFORM);
        let ground = [PERSON].into_iter().chain(stands_on).chain(lifts_from);
        let around = around(&(palm * self.mechanism.grasp_point()), obstacles);
        let links = self.links(query, model);
        let touches = |part: &&Obstacle| {
            links.iter().any(|link| link.distance(&part.bounding_capsule) < ESTIMATE_ERROR)
        };
        let touched = parts_of(obstacles).filter(touches).map(|part| part.name.clone());
        ground.map(str::to_owned).chain(around).chain(touched).collect()
    }
}

/// What the hand may touch at the goal.
fn allowed_at_goal(query: &PlanningQuery, goals: &[GripGoal], obstacles: &[Obstacle]) -> Vec<String> {
    let ground = match query.skill {
        Skill::Give => return vec![PERSON.to_owned()],
        Skill::Insert | Skill::Steady => Fixture::PLATFORM,
        Skill::PutBack => Fixture::TABLE,
        _ => return Vec::new(),
    };
    let place = goals.first().map(|grip_goal| grip_goal.goal.point);
    let near = place.into_iter().flat_map(|place| around(&place, obstacles));
    std::iter::once(ground.to_owned()).chain(near).collect()
}

/// Whether a part that is seen there is this one.
fn is_same(kind: usize, frame: &Isometry3<f64>, other: Option<&(usize, Isometry3<f64>)>) -> bool {
    other.is_some_and(|(same, place)| {
        *same == kind && (place.translation.vector - frame.translation.vector).norm() < SAME
    })
}

/// Names of the parts that lie near a place.
fn around(place: &Point3<f64>, obstacles: &[Obstacle]) -> Vec<String> {
    let near = parts_of(obstacles).filter(|part| {
        part.bounding_capsule.distance_of_line(place) - part.bounding_capsule.radius < NEIGHBOURS
    });
    near.map(|part| part.name.clone()).collect()
}

fn parts_of(obstacles: &[Obstacle]) -> impl Iterator<Item = &Obstacle> {
    obstacles.iter().filter(|obstacle| obstacle.name.starts_with(PART))
}
