use crate::Capsule;
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::shape::SharedShape;
use std::f64::consts::FRAC_PI_2;

/// A form; lengths in m, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// A box with these edges, centred on the frame.
    Box(Vector3<f64>),
    /// A cylinder along z, centred on the frame.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Height.
        height: f64,
    },
    /// A capsule.
    Capsule(Capsule),
}

/// A form as the geometry library has it, which puts a cylinder's axis along y.
#[derive(Clone)]
pub(crate) struct Shape {
    pub shape: SharedShape,
    /// From the library's frame to that of the form.
    pub own: Isometry3<f64>,
}

impl Solid {
    pub(crate) fn shape(&self) -> Shape {
        match *self {
            Self::Box(size) => {
                let [x, y, z] = [0.5 * size.x, 0.5 * size.y, 0.5 * size.z];
                Shape { shape: SharedShape::cuboid(x, y, z), own: Isometry3::identity() }
            }
            Self::Cylinder { radius, height } => {
                let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
                let shape = SharedShape::cylinder(0.5 * height, radius);
                Shape { shape, own: Isometry3::from_parts(Default::default(), upright) }
            }
            Self::Capsule(Capsule { start, end, radius }) => {
                let shape = SharedShape::capsule(vector(&start), vector(&end), radius);
                Shape { shape, own: Isometry3::identity() }
            }
        }
    }

    /// A capsule that encloses the form, which stands at `place`.
    pub fn bounding_capsule(&self, place: &Isometry3<f64>) -> Capsule {
        match *self {
            Self::Box(size) => Capsule::around_box(place, size),
            Self::Cylinder { radius, height } => Capsule::around(place, 0.5 * height, radius),
            Self::Capsule(capsule) => capsule.within(place),
        }
    }
}

/// A pose as the geometry library has it.
pub(crate) fn pose(place: &Isometry3<f64>) -> Pose {
    let (at, turn) = (place.translation.vector, place.rotation.coords);
    Pose::from_parts(
        Vector::new(at.x, at.y, at.z),
        Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w).normalize(),
    )
}

fn vector(point: &Point3<f64>) -> Vector {
    Vector::new(point.x, point.y, point.z)
}
