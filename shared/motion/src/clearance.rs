use crate::frames::Frames;
use crate::solid::pose;
use crate::{Capsule, CollisionModel, Mechanism, Scene, SegmentKind};
use coact_robot::Posture;
use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{self, Contact};
use std::ops::ControlFlow;

/// Distances between a collision_model and all it must stay clear of.
#[derive(Clone, Copy)]
pub struct Clearance<'a> {
    /// Whose collision_model.
    pub mechanism: &'a Mechanism,
    /// Arm, hand, held part.
    pub collision_model: &'a CollisionModel,
    /// The surroundings.
    pub scene: &'a Scene,
    /// What the collision_model is at: the hand, and what it holds, may touch what the scene says on leaving and on the approach, and
    /// fingers that move with the arm stand differently at each segment.
    pub segment: SegmentKind,
}

/// A link near something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proximity {
    /// Index of the link in the collision_model.
    pub link: usize,
    /// What it is near to.
    pub other: Counterpart,
    /// Distance of the surfaces, m; negative when they overlap.
    pub distance: f64,
    /// Change of the distance for each rad of each arm joint, m/rad.
    pub gradient: Posture,
}

/// What a link is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counterpart {
    /// An obstacle, by its index in the scene.
    Obstacle(usize),
    /// Another link of the same collision_model.
    Link(usize),
}

impl Clearance<'_> {
    /// The same at another segment.
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

    /// Whether everything is at least `margin` m away.
    pub fn is_clear(&self, posture: &Posture, margin: f64) -> bool {
        self.visit(posture, margin, &mut |_| ControlFlow::Break(())).is_continue()
    }

    /// Names both sides of a nearness.
    pub(crate) fn names(&self, near: &Proximity) -> (String, String) {
        let other = match near.other {
            Counterpart::Obstacle(index) => &self.scene.obstacles[index].name,
            Counterpart::Link(index) => &self.collision_model.links[index].name,
        };
        (self.collision_model.links[near.link].name.clone(), other.clone())
    }

    /// Calls `found` for what is nearer than `within` m; it answers what to look for from then on.
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
        // What is far from a ball around the hand is far from all of its many links.
        let ball =
            self.collision_model.hand.map(|ball| ball.within(&frames.pose[self.mechanism.joints() - 1]));
        let far_from_hand =
            |bounding_capsule: &Capsule| ball.is_some_and(|ball| are_apart(&ball, bounding_capsule, within));
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

/// Whether two bounding_capsules are certainly farther apart than `within` m.
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

/// Distance of two points that makes a direction, m.
const APART: f64 = 1e-4;

fn vector(vector: Vector) -> Vector3<f64> {
    Vector3::new(vector.x, vector.y, vector.z)
}
