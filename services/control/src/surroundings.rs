//! What the arm keeps clear of on its way, and what the hand may touch.

use crate::errand::Errand;
use crate::guard;
use crate::places::Offer;
use crate::planner::{MARGIN, Planner};
use crate::request::Request;
use crate::senses::frame_of;
use coact_joint_task::Fixture;
use coact_motion::{Capsule, CollisionModel, Obstacle, Scene, Solid};
use nalgebra::{Isometry3, Point3, Vector3};

/// Name of the person's arm among the obstacles.
pub(crate) const PERSON: &str = "person";
/// What is nearer than this to where the hand works may be touched by it there, m.
const NEIGHBOURS: f64 = 0.04;
/// A part of the same kind this near to where one is meant is that one, m.
const SAME: f64 = 0.06;
/// How far ahead the person's arm is kept clear of as well, s.
const AHEAD: f64 = 0.3;
/// By how much more than the guard a plan keeps clear of the person, m.
const FROM_GUARD: f64 = 0.005;

impl Planner {
    /// All that the arm keeps clear of now, besides the person.
    pub(crate) fn scene(&self, request: &Request, offers: &[Offer]) -> Scene {
        let mut obstacles = self.fixtures.clone();
        obstacles.extend(self.parts(request));
        for [x, y, z, half_x, half_y, half_z] in &request.screens[..request.screened] {
            let edges = 2.0 * Vector3::new(*half_x, *half_y, *half_z);
            obstacles.push(Obstacle::new("screen", Solid::Box(edges), &Isometry3::translation(*x, *y, *z)));
        }
        let (allowed_leaving, allowed_at_goal) =
            (self.left(request, &obstacles), self.sought(request, offers, &obstacles));
        Scene { obstacles, allowed_leaving, allowed_at_goal }
    }

    /// The person's arm now, a moment from now and where it will bring a part; only the upper arm when the robot takes
    /// something from the hand.
    pub(crate) fn person(&self, request: &Request) -> Vec<Capsule> {
        let Some(arm) = request.person else { return Vec::new() };
        let count = if request.errand == Errand::Receive && !request.before { 1 } else { usize::MAX };
        let hull = request.kind.filter(|_| request.awaits()).and_then(|kind| self.body.hulls.get(kind));
        let coming = hull.map(|hull| self.places.coming(hull)).into_iter().flatten();
        [0.0, AHEAD].into_iter().flat_map(|ahead| arm.after(ahead).take(count)).chain(coming).collect()
    }

    /// Distance of arm, hand and held part from the person, m, and the direction away from there.
    pub(crate) fn gap(
        &self,
        request: &Request,
        figure: &CollisionModel,
        person: &[Capsule],
    ) -> (f64, Vector3<f64>) {
        let hulls =
            figure.moving_bounding_capsules(&self.mechanism, &request.start.map(|state| state.position));
        let pairs = hulls.iter().flat_map(|hull| person.iter().map(move |capsule| (hull, capsule)));
        let gaps = pairs.map(|(hull, capsule)| (hull.distance(capsule), hull.nearest(capsule)));
        let nearest = gaps.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.map_or((f64::INFINITY, Vector3::z()), |(gap, (mine, theirs))| {
            (gap, (mine - theirs).try_normalize(1e-6).unwrap_or_else(Vector3::z))
        })
    }

    /// The parts in sight, but for what is in a hand or about to come into the robot's; the one that is meant stands where it is
    /// believed to stand.
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
            parts.push(coact_workplace::upright(&format!("part {index}"), *shape, &frame));
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
pub(crate) fn stout(person: &[Capsule], gap: f64) -> impl Iterator<Item = Obstacle> {
    let stouter = (gap - MARGIN.goal).clamp(0.0, guard::MARGIN + FROM_GUARD - MARGIN.path);
    let stout = person.iter().map(move |part| Capsule { radius: part.radius + stouter, ..*part });
    stout.map(|part| Obstacle::moving(PERSON, part))
}

/// Names of the parts that lie near a place.
fn around(place: &Point3<f64>, obstacles: &[Obstacle]) -> Vec<String> {
    let parts = obstacles.iter().filter(|obstacle| obstacle.name.starts_with("part "));
    let near = parts.filter(|part| {
        part.bounding_capsule.distance_of_line(place) - part.bounding_capsule.radius < NEIGHBOURS
    });
    near.map(|part| part.name.clone()).collect()
}
