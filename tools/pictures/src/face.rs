use coact_motion::Solid;
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// One side of a solid, in the solid's own frame.
pub(crate) struct Face {
    /// Its corners, in turn, m.
    pub corners: Vec<Point3<f64>>,
    /// Direction in which it looks.
    pub normal: Vector3<f64>,
}

/// Straight pieces of half a circle: enough that it looks round.
const HALF: u32 = 16;

/// Corners of a rectangle, in units of half its edges.
const RECTANGLE: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

impl Face {
    /// The faces of a box or a cylinder, its round side as it is seen from `eye`, a direction; a capsule has none.
    pub fn of(solid: &Solid, eye: &Vector3<f64>) -> Vec<Self> {
        match *solid {
            Solid::Box(size) => (0..6).map(|side| Self::of_box(size, side)).collect(),
            Solid::Cylinder { radius, height } => {
                let [bottom, top] = [-0.5, 0.5].map(|side| Self::lid(radius, side * height));
                vec![bottom, Self::round_side(radius, height, eye), top]
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
        Self { corners: RECTANGLE.map(corner).to_vec(), normal }
    }

    fn lid(radius: f64, z: f64) -> Self {
        let corners = arc(radius, z, (0.0, 2.0 * PI), 2 * HALF).collect();
        Self { corners, normal: Vector3::z() * z.signum() }
    }

    /// The half of a cylinder's side that looks at the eye.
    fn round_side(radius: f64, height: f64, eye: &Vector3<f64>) -> Self {
        let middle = eye.y.atan2(eye.x);
        let (first, last) = (middle - 0.5 * PI, middle + 0.5 * PI);
        let below = arc(radius, -0.5 * height, (first, last), HALF);
        let above = arc(radius, 0.5 * height, (last, first), HALF);
        let normal = Vector3::new(middle.cos(), middle.sin(), 0.0);
        Self { corners: below.chain(above).collect(), normal }
    }
}

/// Points of a circle about z, at a height of `z` m, from one angle to another, rad.
pub(crate) fn arc(
    radius: f64,
    z: f64,
    (from, to): (f64, f64),
    steps: u32,
) -> impl Iterator<Item = Point3<f64>> {
    (0..=steps).map(move |step| {
        let turn = from + (to - from) * f64::from(step) / f64::from(steps);
        Point3::new(radius * turn.cos(), radius * turn.sin(), z)
    })
}
