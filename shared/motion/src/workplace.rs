//! The fixed things and the parts of a task as obstacles.

use crate::{Capsule, Obstacle, Solid};
use coact_joint_task::{Kind, Shape, Task};
use nalgebra::{Isometry3, Point3, Vector3};

/// Name of the table top among the obstacles.
pub const TABLE: &str = "table";
/// Name of the base on which parts are mounted, of its foot and of its axles.
pub const PLATFORM: &str = "platform";

/// Thickness of the table top, m.
const THICKNESS: f64 = 0.04;
/// Radius of the foot that carries the base, and of its axles, m.
const FOOT: f64 = 0.05;
const AXLE: f64 = 0.006;
/// How far an axle sticks out beyond the place of the part on it, m.
const AXLE_END: f64 = 0.02;

/// Table, base, foot and axles.
pub fn fixtures(task: &Task) -> Vec<Obstacle> {
    let scene = &task.scene;
    let [x, y] = scene.table_centre;
    let [width, depth] = scene.table_size;
    let top = Isometry3::translation(x, y, scene.table_height - 0.5 * THICKNESS);
    let mut found = vec![Obstacle::new(TABLE, Solid::Box(Vector3::new(width, depth, THICKNESS)), &top)];
    let [x, y, z] = scene.platform;
    let upright = |radius: f64, height: f64, from: f64| {
        let solid = Solid::Cylinder { radius, height };
        Obstacle::new(PLATFORM, solid, &Isometry3::translation(x, y, from + 0.5 * height))
    };
    found.push(upright(scene.platform_radius, scene.platform_height, z));
    if z - scene.table_height > 1e-3 {
        found.push(upright(FOOT.min(scene.platform_radius), z - scene.table_height, scene.table_height));
    }
    for goal in task.subgoals.iter().filter(|goal| goal.axis[2].abs() < 0.5) {
        let end = Point3::from(goal.socket) + AXLE_END * Vector3::from(goal.axis);
        let axle = Capsule { start: Point3::new(x, y, goal.socket[2]), end, radius: AXLE };
        found.push(Obstacle::new(PLATFORM, Solid::Capsule(axle), &Isometry3::identity()));
    }
    found
}

/// A part with its frame (centre of its underside, z up) at `frame`.
pub fn part(name: &str, kind: &Kind, frame: &Isometry3<f64>) -> Obstacle {
    let (solid, centre) = form(kind);
    Obstacle::new(name, solid, &(frame * centre))
}

/// The form of a kind of part, and its place in the part's frame.
pub fn form(kind: &Kind) -> (Solid, Isometry3<f64>) {
    let solid = match kind.shape {
        Shape::Cylinder { radius, height } => Solid::Cylinder { radius, height },
        Shape::Box { size } => Solid::Box(Vector3::from(size)),
    };
    (solid, Isometry3::translation(0.0, 0.0, 0.5 * height(kind)))
}

/// Height of a kind of part, m.
pub fn height(kind: &Kind) -> f64 {
    match kind.shape {
        Shape::Cylinder { height, .. } => height,
        Shape::Box { size } => size[2],
    }
}
