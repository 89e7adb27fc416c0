//! The fixed things and the parts of a task as obstacles, and the parts as what is gripped.

use crate::{Capsule, Obstacle, Solid};
use coact_joint_task::{FixtureForm, Kind, Shape, Task};
use coact_robot::Form;
use nalgebra::Isometry3;

/// Table, base, foot and axles.
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

/// Something of this shape with its frame (centre of its underside, z up) at `frame`.
pub fn upright(name: &str, shape: Shape, frame: &Isometry3<f64>) -> Obstacle {
    let (solid, centre) = form(shape);
    Obstacle::new(name, solid, &(frame * centre))
}

/// A kind of part as something that a hand grips.
pub fn grasped(kind: &Kind) -> Form {
    match kind.shape {
        Shape::Cylinder { height, .. } => Form::round(kind.width, height),
        Shape::Box { size } => Form::brick(size, kind.width),
    }
}

/// The form of a shape, and its place in the shape's frame.
pub fn form(shape: Shape) -> (Solid, Isometry3<f64>) {
    let solid = match shape {
        Shape::Cylinder { radius, height } => Solid::Cylinder { radius, height },
        Shape::Box { size } => Solid::Box(size.into()),
    };
    (solid, Isometry3::translation(0.0, 0.0, 0.5 * shape.height()))
}
