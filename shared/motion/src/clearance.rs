use crate::body::Frames;
use crate::solid::pose;
use crate::{Body, Capsule, Mechanism, Scene, StageKind};
use coact_robot::Posture;
use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{self, Contact};
use std::ops::ControlFlow;

/// Distances between a body and all it must stay clear of.
#[derive(Clone, Copy)]
pub struct Clearance<'a> {
    /// Whose body.
    pub mechanism: &'a Mechanism,
    /// Arm, hand, held part.
    pub body: &'a Body,
    /// The surroundings.
    pub scene: &'a Scene,
    /// What the body is at: the hand, and what it holds, may touch what the scene says on leaving and on the approach, and
    /// fingers that move with the arm stand differently at each stage.
    pub stage: StageKind,
}

/// A bone near something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// Index of the bone in the body.
    pub bone: usize,
    /// What it is near to.
    pub other: Other,
    /// Distance of the surfaces, m; negative when they overlap.
    pub distance: f64,
    /// Change of the distance for each rad of each arm joint, m/rad.
    pub slope: Posture,
}

/// What a bone is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Other {
    /// An obstacle, by its index in the scene.
    Obstacle(usize),
    /// Another bone of the same body.
    Bone(usize),
}

impl Clearance<'_> {
    /// The same at another stage.
    pub(crate) fn at(self, stage: StageKind) -> Self {
        Self { stage, ..self }
    }

    /// Everything nearer than `within` m at this posture, into `found`.
    pub fn near(&self, posture: &Posture, within: f64, found: &mut Vec<Near>) {
        found.clear();
        _ = self.visit(posture, within, &mut |near| {
            found.push(near);
            ControlFlow::Continue(within)
        });
    }

    /// What is nearest, if it is nearer than `within` m.
    pub fn nearest(&self, posture: &Posture, within: f64) -> Option<Near> {
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
    pub(crate) fn names(&self, near: &Near) -> (String, String) {
        let other = match near.other {
            Other::Obstacle(index) => &self.scene.obstacles[index].name,
            Other::Bone(index) => &self.body.bones[index].name,
        };
        (self.body.bones[near.bone].name.clone(), other.clone())
    }

    /// Calls `found` for what is nearer than `within` m; it answers what to look for from then on.
    fn visit(
        &self,
        posture: &Posture,
        mut within: f64,
        found: &mut dyn FnMut(Near) -> ControlFlow<(), f64>,
    ) -> ControlFlow<()> {
        let frames = Frames::of(self.mechanism, posture);
        let bones = &self.body.bones;
        let hulls: Vec<Capsule> = bones.iter().map(|bone| bone.hull.within(&frames.carrier(bone))).collect();
        let is_there = |bone: usize| bones[bone].stages[self.stage as usize];
        // What is far from a ball around the hand is far from all of its many bones.
        let ball = self.body.hand.map(|ball| ball.within(&frames.pose[self.mechanism.joints() - 1]));
        let far_from_hand = |hull: &Capsule| ball.is_some_and(|ball| are_apart(&ball, hull, within));
        let obstacles = self.scene.obstacles.iter();
        let far_obstacles: Vec<bool> = obstacles.map(|obstacle| far_from_hand(&obstacle.hull)).collect();
        let far_bones: Vec<bool> = hulls.iter().map(far_from_hand).collect();
        for bone in (0..bones.len()).filter(|bone| bones[*bone].carriers > 0 && is_there(*bone)) {
            for (index, obstacle) in self.scene.obstacles.iter().enumerate() {
                let far = (bones[bone].hand && far_obstacles[index])
                    || are_apart(&hulls[bone], &obstacle.hull, within);
                let near = || self.obstacle_near(&frames, (bone, &hulls[bone]), index, within);
                if let Some(near) = (!far).then(near).flatten() {
                    within = found(near)?;
                }
            }
        }
        for &(one, other) in self.body.pairs.iter().filter(|(one, other)| is_there(*one) && is_there(*other))
        {
            let far = (bones[one].hand && far_bones[other])
                || (bones[other].hand && far_bones[one])
                || are_apart(&hulls[one], &hulls[other], within);
            if let Some(near) = (!far).then(|| self.bone_near(&frames, (one, other), within)).flatten() {
                within = found(near)?;
            }
        }
        ControlFlow::Continue(())
    }

    fn obstacle_near(
        &self,
        frames: &Frames,
        (bone, hull): (usize, &Capsule),
        index: usize,
        within: f64,
    ) -> Option<Near> {
        let (own, obstacle) = (&self.body.bones[bone], &self.scene.obstacles[index]);
        if own.hand && self.scene.hand_may_touch(index, self.stage) {
            return None;
        }
        let (point, away, distance) = if obstacle.coarse {
            let (mine, theirs) = hull.nearest(&obstacle.hull);
            let away = (mine - theirs).try_normalize(APART).unwrap_or_else(Vector3::z);
            (mine, away, (mine - theirs).norm() - hull.radius - obstacle.hull.radius)
        } else {
            let place = pose(&(frames.carrier(own) * own.own));
            let contact = query::contact(&place, &*own.shape, &obstacle.pose, &*obstacle.shape, within);
            let contact = contact.ok().flatten()?;
            let (point, away) = first_side(&contact);
            (point, away, contact.dist)
        };
        let slope = frames.slope(&point, &away, own.carriers);
        (distance < within).then_some(Near { bone, other: Other::Obstacle(index), distance, slope })
    }

    fn bone_near(&self, frames: &Frames, (one, other): (usize, usize), within: f64) -> Option<Near> {
        let (first, second) = (&self.body.bones[one], &self.body.bones[other]);
        let (carrier, second_carrier) = (frames.carrier(first), frames.carrier(second));
        let (place, second_place) = (pose(&(carrier * first.own)), pose(&(second_carrier * second.own)));
        let contact = query::contact(&place, &*first.shape, &second_place, &*second.shape, within);
        let contact = contact.ok().flatten()?;
        let (point, away) = first_side(&contact);
        let (mine, theirs) = (
            frames.slope(&point, &away, first.carriers),
            frames.slope(&Point3::from(vector(contact.point2)), &-away, second.carriers),
        );
        let slope = std::array::from_fn(|joint| mine[joint] + theirs[joint]);
        Some(Near { bone: one, other: Other::Bone(other), distance: contact.dist, slope })
    }
}

/// Whether two hulls are certainly farther apart than `within` m.
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
