use crate::solid::Shape;
use crate::{Capsule, Solid};
use nalgebra::Isometry3;
use parry3d_f64::shape::SharedShape;

/// A link, or a part of its collision geometry, as the planner sees it: a form that a joint of the arm carries. What the
/// hand holds is a link, too.
#[derive(Clone)]
pub struct Link {
    /// The name of the link in the URDF, or of the held part.
    pub name: String,
    /// Arm joints that move it: the first `carriers` of them.
    pub carriers: usize,
    /// Its form.
    pub solid: Solid,
    /// The place of its form's frame in the frame of the last joint that carries it (world, when there is none).
    pub place: Isometry3<f64>,
    /// Whether it belongs to the hand, or to what the hand holds.
    pub hand: bool,
    /// Whether it is there in each segment of a movement, in the order of [`SegmentKind`](crate::SegmentKind). Fingers that
    /// move while the arm does are there as they stand at first while the hand leaves, in all shapes that they pass while
    /// it reaches, and as they stand at last while it approaches.
    pub(crate) segments: [bool; 3],
    /// A capsule that encloses it, where `place` is.
    pub(crate) bounding_capsule: Capsule,
    pub(crate) shape: SharedShape,
    /// Place of the geometry library's frame.
    pub(crate) own: Isometry3<f64>,
}

impl Link {
    pub(crate) fn new(name: &str, carriers: usize, solid: Solid, place: Isometry3<f64>, hand: bool) -> Self {
        let Shape { shape, own } = solid.shape();
        let (name, bounding_capsule) = (name.to_owned(), solid.bounding_capsule(&place));
        Self {
            name,
            carriers,
            solid,
            place,
            hand,
            segments: [true; 3],
            bounding_capsule,
            shape,
            own: place * own,
        }
    }
}

impl std::fmt::Debug for Link {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { name, carriers, solid, place, hand, .. } = self;
        let mut out = out.debug_struct("Link");
        out.field("name", name).field("carriers", carriers).field("solid", solid);
        out.field("place", place).field("hand", hand).finish()
    }
}
