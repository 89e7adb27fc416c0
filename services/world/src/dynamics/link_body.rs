//! Mass and shapes of a robot's link on the body that it is part of.

use super::colliders::{collider, pose};
use super::layer::Layer;
use coact_robot::isometry;
use nalgebra::Isometry3;
use rapier3d::prelude::*;

/// Friction coefficient of the finger pads, of rubber; those of the parts are lower, and the engine takes the mean.
const PAD: f64 = 1.0;

/// Where a link is: on which body, and its pose in that body's frame.
pub(super) type Place = (RigidBodyHandle, Isometry3<f64>);

/// Gives a link's mass and shapes to the body that it is on, and tells the shapes.
pub(super) fn furnish_link(
    world: &mut PhysicsWorld,
    link: &urdf_rs::Link,
    (body, within): &Place,
    layer: Layer,
) -> Vec<ColliderHandle> {
    if let Some(body) = world.bodies.get_mut(*body) {
        let mass = body.mass_properties().additional_local_mprops.as_deref();
        let known = match mass {
            Some(RigidBodyAdditionalMassProps::MassProps(mass)) => *mass,
            _ => MassProperties::default(),
        };
        body.set_additional_mass_properties(known + mass_properties(&link.inertial, within), false);
    }
    let shapes = link.collision.iter().filter_map(|shape| Some((collider(&shape.geometry)?, &shape.origin)));
    shapes
        .map(|((shape, turn), origin)| {
            let place = within * isometry(origin) * turn;
            let shape = shape.density(0.0).friction(PAD).collision_groups(layer.groups());
            world.insert_collider(shape.position(pose(&place)), Some(*body))
        })
        .collect()
}

fn mass_properties(inertial: &urdf_rs::Inertial, within: &Isometry3<f64>) -> MassProperties {
    let place = within * isometry(&inertial.origin);
    let inertia = &inertial.inertia;
    let tensor = nalgebra::Matrix3::new(
        inertia.ixx,
        inertia.ixy,
        inertia.ixz,
        inertia.ixy,
        inertia.iyy,
        inertia.iyz,
        inertia.ixz,
        inertia.iyz,
        inertia.izz,
    );
    let turn = place.rotation.to_rotation_matrix();
    let turned = turn * tensor * turn.transpose();
    let matrix = Matrix::from_cols_array(&turned.as_slice().try_into().unwrap_or([0.0; 9]));
    let centre = place.translation.vector;
    MassProperties::with_inertia_matrix(
        Vector::new(centre.x, centre.y, centre.z),
        inertial.mass.value,
        matrix,
    )
}
