use crate::solid::{Shape, pose};
use crate::{Capsule, Solid};
use nalgebra::Isometry3;
use parry3d_f64::math::Pose;
use parry3d_f64::shape::SharedShape;

/// Something that arm, hand and held part must stay clear of.
#[derive(Clone)]
pub struct Obstacle {
    /// What it is called in refusals and reports.
    pub name: String,
    /// Its form.
    pub solid: Solid,
    /// The place of its form's frame, world.
    pub place: Isometry3<f64>,
    /// A capsule that encloses it, world.
    pub bounding_capsule: Capsule,
    /// Whether distances from it are measured between bounding capsules instead of forms: as coarsely as a person who moves
    /// is known.
    pub coarse: bool,
    pub(crate) shape: SharedShape,
    pub(crate) pose: Pose,
}

impl Obstacle {
    /// An obstacle of this form with its frame at `place` (world).
    pub fn new(name: impl Into<String>, solid: Solid, place: &Isometry3<f64>) -> Self {
        let Shape { shape, own } = solid.shape();
        let (bounding_capsule, pose) = (solid.bounding_capsule(place), pose(&(place * own)));
        Self { name: name.into(), solid, place: *place, bounding_capsule, coarse: false, shape, pose }
    }

    /// A person, or something else that moves, within a capsule.
    pub fn moving(name: impl Into<String>, capsule: Capsule) -> Self {
        Self { coarse: true, ..Self::new(name, Solid::Capsule(capsule), &Isometry3::identity()) }
    }
}

impl std::fmt::Debug for Obstacle {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { name, solid, place, .. } = self;
        out.debug_struct("Obstacle").field("name", name).field("solid", solid).field("place", place).finish()
    }
}
