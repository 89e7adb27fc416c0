//! A task's fixtures and parts in the planner's terms: as obstacles, and as what the hand grips.
//!
//! The planner (`coact_motion`) knows no task, and a task (`coact_joint_task`) knows no planner; this crate translates.
//!
//! ```
//! use coact_joint_task::Task;
//! use nalgebra::Isometry3;
//!
//! let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/tasks/toy-vehicle.toml");
//! let task = Task::load(file.as_ref())?;
//! let obstacles = coact_workplace::fixtures(&task);
//! assert!(obstacles.iter().any(|obstacle| obstacle.name == coact_joint_task::Fixture::TABLE));
//!
//! // A part on the table: an obstacle for the arm, and something that the hand can grip.
//! let kind = &task.kinds[task.parts[0].kind];
//! let frame = Isometry3::translation(-0.4, 0.5, task.scene.table_height);
//! let part = coact_workplace::upright(&kind.name, kind.shape, &frame);
//! assert!(part.bounding_capsule.radius > 0.0);
//! assert_eq!(coact_workplace::graspable(kind).height, kind.shape.height());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use coact_joint_task::{FixtureForm, Kind, Shape, Task};
use coact_motion::{Capsule, Obstacle, Solid};
use coact_robot::Graspable;
use nalgebra::Isometry3;

/// All fixtures of a task (table, base, foot, axles) as obstacles.
pub fn fixtures(task: &Task) -> Vec<Obstacle> {
    let obstacle = |fixture: coact_joint_task::Fixture| match fixture.form {
        FixtureForm::Upright { shape, underside: [x, y, z] } => {
            upright(fixture.name, shape, &Isometry3::translation(x, y, z))
        }
        FixtureForm::Rod { from, to, radius } => {
            let rod = Capsule { start: from.into(), end: to.into(), radius };
            Obstacle::new(fixture.name, Solid::Capsule(rod), &Isometry3::identity())
        }
    };
    task.fixtures().into_iter().map(obstacle).collect()
}

/// An obstacle of this shape with its frame (centre of its underside, z up) at `frame`, world.
pub fn upright(name: &str, shape: Shape, frame: &Isometry3<f64>) -> Obstacle {
    let (solid, centre) = solid(shape);
    Obstacle::new(name, solid, &(frame * centre))
}

/// A part of this kind as something that the hand grips.
pub fn graspable(kind: &Kind) -> Graspable {
    match kind.shape {
        Shape::Cylinder { height, .. } => Graspable::round(kind.width, height),
        Shape::Box { size } => Graspable::brick(size, kind.width),
    }
}

/// The solid of a shape, and the pose of the solid's frame (its centre) in the shape's frame (centre of its underside).
pub fn solid(shape: Shape) -> (Solid, Isometry3<f64>) {
    let solid = match shape {
        Shape::Cylinder { radius, height } => Solid::Cylinder { radius, height },
        Shape::Box { size } => Solid::Box(size.into()),
    };
    (solid, Isometry3::translation(0.0, 0.0, 0.5 * shape.height()))
}
