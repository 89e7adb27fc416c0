use crate::solid::Shape;
use crate::{Capsule, Clearance, Mechanism, Other, Scene, Solid, StageKind};
use coact_robot::Posture;
use nalgebra::{Isometry3, Point3, SMatrix, Vector3};
use parry3d_f64::shape::SharedShape;

/// Arm, hand and what it holds, as forms that move with the arm's joints. The fingers stand still in it, or pass from one
/// shape to another on the way.
#[derive(Debug, Clone)]
pub struct Body {
    pub(crate) bones: Vec<Bone>,
    /// Pairs of bones that could touch each other.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// A ball around all bones of the hand, in the frame of the arm's last joint.
    pub(crate) hand: Option<Capsule>,
}

/// A form that is carried by a joint of the arm.
#[derive(Clone)]
pub struct Bone {
    /// The link, or the part, that it stands for.
    pub name: String,
    /// Arm joints that move it: the first `carriers` of them.
    pub carriers: usize,
    /// Its form.
    pub solid: Solid,
    /// The place of its form's frame in the frame of the last joint that carries it (world, when there is none).
    pub place: Isometry3<f64>,
    /// Whether it belongs to the hand, or to what the hand holds.
    pub hand: bool,
    /// Whether it is there at each stage of a movement, in the order of [`StageKind`]: where fingers move with the arm,
    /// they are there as they stand at first, on the way in all shapes that they pass, and at last as they shall stand.
    pub(crate) stages: [bool; 3],
    /// A capsule around it, where `place` is.
    pub(crate) hull: Capsule,
    pub(crate) shape: SharedShape,
    /// Place of the geometry library's frame.
    pub(crate) own: Isometry3<f64>,
}

impl Bone {
    pub(crate) fn new(name: &str, carriers: usize, solid: Solid, place: Isometry3<f64>, hand: bool) -> Self {
        let Shape { shape, own } = solid.shape();
        let (name, hull) = (name.to_owned(), solid.hull(&place));
        Self { name, carriers, solid, place, hand, stages: [true; 3], hull, shape, own: place * own }
    }
}

impl std::fmt::Debug for Bone {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { name, carriers, solid, place, hand, .. } = self;
        let mut out = out.debug_struct("Bone");
        out.field("name", name).field("carriers", carriers).field("solid", solid);
        out.field("place", place).field("hand", hand).finish()
    }
}

/// Poses of all joint frames of an arm, and the axes about which they turn, in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frames {
    pub pose: [Isometry3<f64>; 7],
    pub axis: [Vector3<f64>; 7],
}

impl Frames {
    pub fn of(mechanism: &Mechanism, posture: &Posture) -> Self {
        let mut frames = Self { pose: [Isometry3::identity(); 7], axis: [Vector3::zeros(); 7] };
        let mut pose = Isometry3::identity();
        for (index, (joint, &angle)) in mechanism.arm.joints.iter().zip(posture).enumerate() {
            pose *= joint.transform(angle);
            frames.pose[index] = pose;
            frames.axis[index] = pose.rotation * joint.axis.into_inner();
        }
        frames
    }

    /// Change of the position of `point` (world, carried by the first `carriers` joints) along `direction`, for each
    /// rad of each joint: m/rad.
    pub fn slope(&self, point: &nalgebra::Point3<f64>, direction: &Vector3<f64>, carriers: usize) -> Posture {
        std::array::from_fn(|joint| {
            if joint >= carriers {
                return 0.0;
            }
            let arm = point.coords - self.pose[joint].translation.vector;
            self.axis[joint].cross(&arm).dot(direction)
        })
    }

    /// Change of the position of `point` (world, carried by the first `carriers` joints), m/rad.
    pub fn jacobian(&self, point: &nalgebra::Point3<f64>, carriers: usize) -> SMatrix<f64, 3, 7> {
        let mut columns = SMatrix::<f64, 3, 7>::zeros();
        for joint in 0..carriers {
            let arm = point.coords - self.pose[joint].translation.vector;
            columns.set_column(joint, &self.axis[joint].cross(&arm));
        }
        columns
    }

    /// Pose of what carries a bone, world.
    pub fn carrier(&self, bone: &Bone) -> Isometry3<f64> {
        bone.carriers.checked_sub(1).map_or_else(Isometry3::identity, |joint| self.pose[joint])
    }
}

impl Body {
    /// A body of these bones. Pairs that at least two joints separate are watched, but for those that touch each other
    /// at rest: their forms are too coarse to tell what is between them, or one is mounted on the other.
    pub(crate) fn new(mechanism: &Mechanism, bones: Vec<Bone>) -> Self {
        let apart = |one: &Bone, other: &Bone| one.carriers.abs_diff(other.carriers) >= 3;
        let mut pairs = Vec::new();
        for one in 0..bones.len() {
            pairs.extend(
                (0..one).filter(|&other| apart(&bones[one], &bones[other])).map(|other| (one, other)),
            );
        }
        let of_hand = || bones.iter().filter(|bone| bone.hand);
        let ends: Vec<Point3<f64>> = of_hand().flat_map(|bone| [bone.hull.start, bone.hull.end]).collect();
        let hand = Capsule::around_points(&ends).map(|around| {
            let centre = nalgebra::center(&around.start, &around.end);
            let reach = |bone: &Bone| {
                let ends = [bone.hull.start, bone.hull.end];
                bone.hull.radius + ends.iter().map(|end| (end - centre).norm()).fold(0.0, f64::max)
            };
            Capsule { start: centre, end: centre, radius: of_hand().map(reach).fold(0.0, f64::max) }
        });
        let (mut body, mut touching) = (Self { bones, pairs, hand }, Vec::new());
        let scene = Scene::default();
        let mut near = Vec::new();
        for stage in StageKind::ALL {
            let clearance = Clearance { mechanism, body: &body, scene: &scene, stage };
            clearance.near(&mechanism.park, 0.0, &mut near);
            touching.append(&mut near);
        }
        let touches = |&(one, other): &(usize, usize)| {
            touching.iter().any(|near| near.bone == one && near.other == Other::Bone(other))
        };
        body.pairs.retain(|pair| !touches(pair));
        body
    }

    /// Its bones.
    pub fn bones(&self) -> &[Bone] {
        &self.bones
    }

    /// The same body with a part in its hand, its form's frame at `place` in the palm frame.
    pub fn holding(
        mut self,
        mechanism: &Mechanism,
        name: &str,
        solid: Solid,
        place: &Isometry3<f64>,
    ) -> Self {
        let place = mechanism.arm.tool * place;
        self.bones.push(Bone::new(name, mechanism.joints(), solid, place, true));
        Self::new(mechanism, self.bones)
    }

    /// Capsules around all bones that the arm's joints move, in the world, for a posture of the arm.
    pub fn moving_hulls(&self, mechanism: &Mechanism, posture: &Posture) -> Vec<Capsule> {
        let hulls = self.bones.iter().zip(self.hulls(mechanism, posture));
        hulls.filter(|(bone, _)| bone.carriers > 0).map(|(_, hull)| hull).collect()
    }

    /// Distance of what the arm's joints move, with or without the hand and what it holds, from the nearest of `others`
    /// (world), for a posture of the arm, m, measured between capsules; `most` when it is more. Nothing is allocated.
    pub fn distance(
        &self,
        mechanism: &Mechanism,
        posture: &Posture,
        others: &[Capsule],
        with_hand: bool,
        most: f64,
    ) -> f64 {
        let frames = Frames::of(mechanism, posture);
        let nearer = |nearest: f64, bone: &Bone| {
            let hull = bone.hull.within(&frames.carrier(bone));
            others.iter().fold(nearest, |nearest, other| {
                // Most pairs are certainly farther apart than the nearest one so far.
                if hull.least_distance(other) < nearest { nearest.min(hull.distance(other)) } else { nearest }
            })
        };
        let moving = self.bones.iter().filter(|bone| bone.carriers > 0);
        let nearest = moving.clone().filter(|bone| !bone.hand).fold(most, nearer);
        // What is far from a ball around the hand is far from all of its many bones.
        let ball = self.hand.map(|ball| ball.within(&frames.pose[mechanism.joints() - 1]));
        let far = |ball: &Capsule| others.iter().all(|other| other.least_distance(ball) >= nearest);
        if !with_hand || ball.is_some_and(|ball| far(&ball)) {
            return nearest;
        }
        moving.filter(|bone| bone.hand).fold(nearest, nearer)
    }

    /// Capsules around all bones in the world, for a posture of the arm.
    pub fn hulls(&self, mechanism: &Mechanism, posture: &Posture) -> Vec<Capsule> {
        let frames = Frames::of(mechanism, posture);
        self.bones.iter().map(|bone| bone.hull.within(&frames.carrier(bone))).collect()
    }
}
