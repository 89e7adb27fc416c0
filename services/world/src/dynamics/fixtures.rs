use super::colliders::{PART_FRICTION, part_collider, pose};
use super::layer::Layer;
use crate::WorldError;
use coact_joint_task::{FixtureForm, Task};
use glam::DVec2;
use nalgebra::Isometry3;
use rapier3d::prelude::*;

/// By how much parts may overlap at the start, m: deep penetration drives the engine to NaN.
const OVERLAP: f64 = 0.001;

/// Puts table, base, foot and axle into the scene.
///
/// # Errors
/// [`WorldError::Scene`] when parts overlap each other or the base, or do not lie on the table.
pub(super) fn insert_fixtures(world: &mut PhysicsWorld, task: &Task) -> Result<(), WorldError> {
    check(task)?;
    for fixture in task.fixtures() {
        let shape = match fixture.form {
            FixtureForm::Upright { shape, underside: [x, y, z] } => {
                let shape = part_collider(shape);
                let place = pose(&Isometry3::translation(x, y, z)) * shape.position;
                shape.position(place)
            }
            FixtureForm::Rod { from, to, radius } => {
                let point = |at: [f64; 3]| Vector::from(at);
                ColliderBuilder::capsule_from_endpoints(point(from), point(to), radius)
            }
        };
        world.insert_collider(shape.friction(PART_FRICTION).collision_groups(Layer::Fixture.groups()), None);
    }
    Ok(())
}

/// Refuses a layout that would start in penetration or in mid-air.
fn check(task: &Task) -> Result<(), WorldError> {
    let fault = |message: String| Err(WorldError::Scene { task: task.name.clone(), message });
    let (scene, radius) = (&task.scene, |part: usize| task.kinds[task.parts[part].kind].shape.radius());
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
