use crate::frames::Frames;
use crate::solid::pose;
use crate::{Capsule, CollisionModel, Counterpart, Mechanism, Proximity, Scene, SegmentKind};
use coact_robot::Posture;
use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{self, Contact};
use std::ops::ControlFlow;

/// The clearance of a robot: its distances from obstacles and from itself.
#[derive(Clone, Copy)]
pub struct Clearance<'a> {
    /// The arm.
    pub mechanism: &'a Mechanism,
    /// The forms of arm, hand and held part.
    pub collision_model: &'a CollisionModel,
    /// The surroundings.
    pub scene: &'a Scene,
    /// The segment of the movement. The hand, and what it holds, may touch what the scene allows while it leaves and while
    /// it approaches; fingers that move while the arm does stand differently in each segment.
    pub segment: SegmentKind,
}

/// Distance of two points below which no direction is computed from them, m: it would be one of rounding.
const APART: f64 = 1e-4;

impl Clearance<'_> {
    /// The same in another segment.
    pub(crate) fn at(self, segment: SegmentKind) -> Self {
        Self { segment, ..self }
    }

    /// Everything nearer than `within` m at this posture, into `found`.
    pub fn near(&self, posture: &Posture, within: f64, found: &mut Vec<Proximity>) {
        found.clear();
        _ = self.visit(posture, within, &mut |near| {
            found.push(near);
            ControlFlow::Continue(within)
        });
    }

    /// What is nearest, if it is nearer than `within` m.
    pub fn nearest(&self, posture: &Posture, within: f64) -> Option<Proximity> {
        let mut nearest = None;
        _ = self.visit(posture, within, &mut |near| {
            nearest = Some(near);
            ControlFlow::Continue(near.distance)
        });
        nearest
    }

    /// Whether everything is at least `least` m away.
    pub fn is_clear(&self, posture: &Posture, least: f64) -> bool {
        self.visit(posture, least, &mut |_| ControlFlow::Break(())).is_continue()
    }

    /// Names of a link and of what it is near to.
    pub(crate) fn names(&self, near: &Proximity) -> (String, String) {
        let other = match near.other {
            Counterpart::Obstacle(index) => &self.scene.obstacles[index].name,
            Counterpart::Link(index) => &self.collision_model.links[index].name,
        };
        (self.collision_model.links[near.link].name.clone(), other.clone())
    }

    /// Calls `found` for what is nearer than `within` m; `found` returns the distance from then on.
    fn visit(
        &self,
        posture: &Posture,
        mut within: f64,
        found: &mut dyn FnMut(Proximity) -> ControlFlow<(), f64>,
    ) -> ControlFlow<()> {
        let frames = Frames::of(self.mechanism, posture);
        let links = &self.collision_model.links;
        let bounding_capsules: Vec<Capsule> =
            links.iter().map(|link| link.bounding_capsule.within(&frames.carrier(link))).collect();
        let is_there = |link: usize| links[link].segments[self.segment as usize];
        // What is far from a sphere around the hand is far from all of its many links.
        let sphere =
            self.collision_model.hand.map(|sphere| sphere.within(&frames.pose[self.mechanism.joints() - 1]));
        let far_from_hand = |bounding_capsule: &Capsule| {
            sphere.is_some_and(|sphere| are_apart(&sphere, bounding_capsule, within))
        };
        let obstacles = self.scene.obstacles.iter();
        let far_obstacles: Vec<bool> =
            obstacles.map(|obstacle| far_from_hand(&obstacle.bounding_capsule)).collect();
        let far_links: Vec<bool> = bounding_capsules.iter().map(far_from_hand).collect();
        for link in (0..links.len()).filter(|link| links[*link].carriers > 0 && is_there(*link)) {
            for (index, obstacle) in self.scene.obstacles.iter().enumerate() {
                let far = (links[link].hand && far_obstacles[index])
                    || are_apart(&bounding_capsules[link], &obstacle.bounding_capsule, within);
                let near = || self.obstacle_near(&frames, (link, &bounding_capsules[link]), index, within);
                if let Some(near) = (!far).then(near).flatten() {
                    within = found(near)?;
                }
            }
        }
        for &(one, other) in
            self.collision_model.pairs.iter().filter(|(one, other)| is_there(*one) && is_there(*other))
        {
            let far = (links[one].hand && far_links[other])
                || (links[other].hand && far_links[one])
                || are_apart(&bounding_capsules[one], &bounding_capsules[other], within);
            if let Some(near) = (!far).then(|| self.link_near(&frames, (one, other), within)).flatten() {
                within = found(near)?;
            }
        }
        ControlFlow::Continue(())
    }

    fn obstacle_near(
        &self,
        frames: &Frames,
        (link, bounding_capsule): (usize, &Capsule),
        index: usize,
        within: f64,
    ) -> Option<Proximity> {
        let (own, obstacle) = (&self.collision_model.links[link], &self.scene.obstacles[index]);
        if own.hand && self.scene.hand_may_touch(index, self.segment) {
            return None;
        }
        let (point, away, distance) = if obstacle.coarse {
            let (mine, theirs) = bounding_capsule.nearest(&obstacle.bounding_capsule);
            let away = (mine - theirs).try_normalize(APART).unwrap_or_else(Vector3::z);
            (mine, away, (mine - theirs).norm() - bounding_capsule.radius - obstacle.bounding_capsule.radius)
        } else {
            let place = pose(&(frames.carrier(own) * own.own));
            let contact = query::contact(&place, &*own.shape, &obstacle.pose, &*obstacle.shape, within);
            let contact = contact.ok().flatten()?;
            let (point, away) = first_side(&contact);
            (point, away, contact.dist)
        };
        let gradient = frames.gradient(&point, &away, own.carriers);
        (distance < within).then_some(Proximity {
            link,
            other: Counterpart::Obstacle(index),
            distance,
            gradient,
        })
    }

    fn link_near(&self, frames: &Frames, (one, other): (usize, usize), within: f64) -> Option<Proximity> {
        let (first, second) = (&self.collision_model.links[one], &self.collision_model.links[other]);
        let (carrier, second_carrier) = (frames.carrier(first), frames.carrier(second));
        let (place, second_place) = (pose(&(carrier * first.own)), pose(&(second_carrier * second.own)));
        let contact = query::contact(&place, &*first.shape, &second_place, &*second.shape, within);
        let contact = contact.ok().flatten()?;
        let (point, away) = first_side(&contact);
        let (mine, theirs) = (
            frames.gradient(&point, &away, first.carriers),
            frames.gradient(&Point3::from(vector(contact.point2)), &-away, second.carriers),
        );
        let gradient = std::array::from_fn(|joint| mine[joint] + theirs[joint]);
        Some(Proximity { link: one, other: Counterpart::Link(other), distance: contact.dist, gradient })
    }
}

/// Whether two bounding capsules are certainly farther apart than `within` m.
fn are_apart(one: &Capsule, other: &Capsule, within: f64) -> bool {
    one.least_distance(other) > within || other.least_distance(one) > within
}

/// The point of the first shape, and the direction in which it gets away from the second.
fn first_side(contact: &Contact) -> (Point3<f64>, Vector3<f64>) {
    let (first, second) = (vector(contact.point1), vector(contact.point2));
    // Where the shapes are apart, their nearest points are known better than the normal between them.
    let away = (first - second).try_normalize(APART).filter(|_| contact.dist > 0.0);
    (Point3::from(first), away.unwrap_or_else(|| -vector(contact.normal1)))
}

fn vector(vector: Vector) -> Vector3<f64> {
    Vector3::new(vector.x, vector.y, vector.z)
}
