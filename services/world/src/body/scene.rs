use super::shapes::{Layer, pose, upright};
use crate::WorldError;
use coact_joint_task::{Shape, Task};
use glam::{DVec2, DVec3};
use nalgebra::Isometry3;
use rapier3d::prelude::*;

/// Thickness of the table top, m.
const TABLE: f64 = 0.04;
/// Radius of the foot that carries the base, and of its axle, m.
const FOOT: f64 = 0.05;
const AXLE: f64 = 0.006;
/// How far the axle sticks out beyond the parts on it, m.
const AXLE_END: f64 = 0.02;
/// By how much parts may overlap at the start, m: deep penetration drives the engine to NaN.
const OVERLAP: f64 = 0.001;

/// Puts table, base, foot and axle into the scene.
///
/// # Errors
/// [`WorldError::Scene`] when parts overlap each other or the base, or do not lie on the table.
pub(super) fn furnish_scene(world: &mut PhysicsWorld, task: &Task) -> Result<(), WorldError> {
    check(task)?;
    let scene = &task.scene;
    let [x, y] = scene.table_centre;
    let [width, depth] = scene.table_size.map(|extent| 0.5 * extent as f32);
    let top = ColliderBuilder::cuboid(width, depth, 0.5 * TABLE as f32);
    fix(world, top, Isometry3::translation(x, y, scene.table_height - 0.5 * TABLE));
    let [x, y, z] = scene.platform;
    cylinder(world, scene.platform_radius, scene.platform_height, [x, y, z]);
    let clearance = z - scene.table_height;
    if clearance > 1e-3 {
        cylinder(world, FOOT.min(scene.platform_radius), clearance, [x, y, scene.table_height]);
    }
    for goal in task.subgoals.iter().filter(|goal| goal.axis[2].abs() < 0.5) {
        axle(world, DVec3::new(x, y, goal.socket[2]), DVec3::from(goal.socket), DVec3::from(goal.axis));
    }
    Ok(())
}

/// A socket that points sideways is the end of an axle which comes out of the base.
fn axle(world: &mut PhysicsWorld, from: DVec3, socket: DVec3, axis: DVec3) {
    let end = socket + AXLE_END * axis;
    let point = |at: DVec3| Vector::from(at.as_vec3().to_array());
    let capsule = ColliderBuilder::capsule_from_endpoints(point(from), point(end), AXLE as f32);
    fix(world, capsule, Isometry3::identity());
}

fn cylinder(world: &mut PhysicsWorld, radius: f64, height: f64, [x, y, z]: [f64; 3]) {
    let shape = ColliderBuilder::cylinder(0.5 * height as f32, radius as f32);
    fix(world, shape, Isometry3::translation(x, y, z + 0.5 * height) * upright());
}

fn fix(world: &mut PhysicsWorld, shape: ColliderBuilder, place: Isometry3<f64>) {
    let offset = pose(&place) * shape.position;
    let collider = shape.position(offset).friction(0.7).collision_groups(Layer::Fixture.groups());
    world.insert_collider(collider, None);
}

/// Refuses a layout that would start in penetration or in mid-air.
fn check(task: &Task) -> Result<(), WorldError> {
    let fault = |message: String| Err(WorldError::Scene { task: task.name.clone(), message });
    let (scene, radius) = (&task.scene, |part: usize| radius(task.kinds[task.parts[part].kind].shape));
    let name = |part: usize| format!("part {part} (\"{}\")", task.kinds[task.parts[part].kind].name);
    for part in 0..task.parts.len() {
        let at = DVec2::from(task.parts[part].at);
        let off = (at - DVec2::from(scene.table_centre)).abs() - 0.5 * DVec2::from(scene.table_size);
        if off.max_element() > 0.0 {
            return fault(format!("{} does not lie on the table; move its `at` onto it", name(part)));
        }
        let base = DVec2::new(scene.platform[0], scene.platform[1]);
        if at.distance(base) < radius(part) + scene.platform_radius - OVERLAP {
            return fault(format!("{} lies within the base; move its `at` away from it", name(part)));
        }
        for other in 0..part {
            let gap = at.distance(DVec2::from(task.parts[other].at)) - radius(part) - radius(other);
            if gap < -OVERLAP {
                let (one, other) = (name(part), name(other));
                return fault(format!("{one} and {other} overlap by {:.0} mm; move them apart", -1e3 * gap));
            }
        }
    }
    Ok(())
}

fn radius(shape: Shape) -> f64 {
    match shape {
        Shape::Cylinder { radius, .. } => radius,
        Shape::Box { size } => 0.5 * size[0].hypot(size[1]),
    }
}
