use coact_motion::Solid;
use nalgebra::{Point3, Vector3};

/// A flat piece of a form's surface, in the form's own frame.
pub(crate) struct Face {
    /// Its corners, in turn, m.
    pub corners: Vec<Point3<f64>>,
    /// Direction in which it looks.
    pub normal: Vector3<f64>,
}

/// Pieces of a circle.
pub(crate) const CIRCLE: u32 = 24;

/// Corners of a rectangle, in units of half its edges.
const SQUARE: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

impl Face {
    /// The faces of a box or a cylinder; a capsule has none.
    pub fn of(solid: &Solid) -> Vec<Self> {
        match *solid {
            Solid::Box(size) => (0..6).map(|side| Self::of_box(size, side)).collect(),
            Solid::Cylinder { radius, height } => {
                let lids = [-1.0, 1.0].map(|side| Self::lid(radius, 0.5 * side * height));
                lids.into_iter().chain((0..CIRCLE).map(|step| Self::stave(radius, height, step))).collect()
            }
            Solid::Capsule(_) => Vec::new(),
        }
    }

    fn of_box(size: Vector3<f64>, side: usize) -> Self {
        let (axis, sign) = (side % 3, if side < 3 { -1.0 } else { 1.0 });
        let corner = |(one, other): (f64, f64)| {
            let mut corner = Point3::origin();
            corner[axis] = 0.5 * sign * size[axis];
            corner[(axis + 1) % 3] = 0.5 * one * size[(axis + 1) % 3];
            corner[(axis + 2) % 3] = 0.5 * other * size[(axis + 2) % 3];
            corner
        };
        let mut normal = Vector3::zeros();
        normal[axis] = sign;
        Self { corners: SQUARE.map(corner).to_vec(), normal }
    }

    fn lid(radius: f64, z: f64) -> Self {
        let corners = (0..CIRCLE).map(|step| on_circle(radius, f64::from(step), z)).collect();
        Self { corners, normal: Vector3::z() * z.signum() }
    }

    /// One of the flat pieces of which a cylinder's side is made.
    fn stave(radius: f64, height: f64, step: u32) -> Self {
        let corner = |(along, up): (f64, f64)| {
            on_circle(radius, f64::from(step) + 0.5 * along, 0.5 * up * height)
        };
        let normal = on_circle(1.0, f64::from(step), 0.0).coords;
        Self { corners: SQUARE.map(corner).to_vec(), normal }
    }
}

/// A point of a circle about z, `steps` of [`CIRCLE`] on, at a height of `z` m.
pub(crate) fn on_circle(radius: f64, steps: f64, z: f64) -> Point3<f64> {
    let turn = std::f64::consts::TAU * steps / f64::from(CIRCLE);
    Point3::new(radius * turn.cos(), radius * turn.sin(), z)
}
