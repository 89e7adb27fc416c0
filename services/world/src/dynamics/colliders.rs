//! Shapes of tasks and URDFs as colliders. The physics engine's cylinders stand along y, ours along z.

use coact_joint_task::Shape;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Friction coefficient of parts: wood or plastic on wood. Chosen by hand.
pub(super) const PART_FRICTION: f64 = 0.7;

/// Turns the engine's y axis onto our z axis.
pub(super) fn upright() -> Isometry3<f64> {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
    Isometry3::from_parts(Default::default(), turn)
}

/// Collider of a part in the part's frame, whose origin is at the centre of its underside.
pub(super) fn part_collider(shape: Shape) -> ColliderBuilder {
    let half = 0.5 * shape.height();
    let centre = Isometry3::translation(0.0, 0.0, half);
    match shape {
        Shape::Cylinder { radius, .. } => {
            ColliderBuilder::cylinder(half, radius).position(pose(&(centre * upright())))
        }
        Shape::Box { size } => {
            let [x, y, z] = size.map(|extent| 0.5 * extent);
            ColliderBuilder::cuboid(x, y, z).position(pose(&centre))
        }
    }
}

/// Collider of a URDF geometry and how it is turned; none for a mesh, which our robot files do not use.
pub(super) fn collider(geometry: &urdf_rs::Geometry) -> Option<(ColliderBuilder, Isometry3<f64>)> {
    Some(match geometry {
        urdf_rs::Geometry::Box { size } => {
            let [x, y, z] = size.0.map(|extent| 0.5 * extent);
            (ColliderBuilder::cuboid(x, y, z), Isometry3::identity())
        }
        urdf_rs::Geometry::Cylinder { radius, length } => {
            (ColliderBuilder::cylinder(0.5 * *length, *radius), upright())
        }
        urdf_rs::Geometry::Capsule { radius, length } => {
            (ColliderBuilder::capsule_y(0.5 * *length, *radius), upright())
        }
        urdf_rs::Geometry::Sphere { radius } => (ColliderBuilder::ball(*radius), Isometry3::identity()),
        urdf_rs::Geometry::Mesh { .. } => return None,
    })
}

/// A pose in the engine's own type.
pub(super) fn pose(place: &Isometry3<f64>) -> Pose {
    let (at, turn) = (place.translation.vector, place.rotation.coords);
    Pose::from_parts(
        Vector::new(at.x, at.y, at.z),
        Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w).normalize(),
    )
}
