use coact_figures::{Place, Sheet};
use coact_motion::{Capsule, Obstacle, Solid};
use nalgebra::{Point3, Vector3};
use plotters::prelude::RGBColor;

/// A look at the scene from obliquely above, without perspective.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View {
    right: Vector3<f64>,
    up: Vector3<f64>,
    towards: Vector3<f64>,
    /// What lies in the middle of the picture, m.
    centre: Point3<f64>,
    /// Pixels for each metre.
    scale: f64,
    /// The middle of the picture.
    middle: Place,
}

/// Something that is drawn, and how near it is to the eye.
pub(crate) struct Stroke {
    places: Vec<Place>,
    width: u32,
    colour: RGBColor,
    near: f64,
}

/// Pieces of a circle.
const CIRCLE: u32 = 24;

impl View {
    /// From the person's side of the table, to the left and above, such that all of this fits into a picture.
    pub fn of(capsules: &[Capsule], size: [i32; 2]) -> Self {
        let towards = Vector3::new(-0.75, 0.45, 0.5).normalize();
        let right = Vector3::z().cross(&towards).normalize();
        let mut view = Self {
            right,
            up: towards.cross(&right),
            towards,
            centre: Point3::origin(),
            scale: 1.0,
            middle: [0, 0],
        };
        let extent = |axis: Vector3<f64>| {
            let along = |capsule: &Capsule| [capsule.start, capsule.end].map(|end| end.coords.dot(&axis));
            let ends = || capsules.iter().flat_map(|capsule| along(capsule).map(|at| (at, capsule.radius)));
            let low = ends().map(|(at, radius)| at - radius).fold(f64::INFINITY, f64::min);
            let high = ends().map(|(at, radius)| at + radius).fold(f64::NEG_INFINITY, f64::max);
            (0.5 * (low + high), (high - low).max(0.1))
        };
        let ((x, wide), (y, high)) = (extent(view.right), extent(view.up));
        view.centre = Point3::from(view.right * x + view.up * y);
        view.scale = 0.92 * (f64::from(size[0]) / wide).min(f64::from(size[1]) / high);
        view
    }

    /// The same look in another picture.
    pub fn moved_to(self, middle: Place) -> Self {
        Self { middle, ..self }
    }

    /// Where a point is in the picture.
    pub fn place(&self, point: &Point3<f64>) -> Place {
        let off = point - self.centre;
        let along = |axis: &Vector3<f64>| (self.scale * off.dot(axis)).round() as i32;
        [self.middle[0] + along(&self.right), self.middle[1] - along(&self.up)]
    }

    /// A capsule as a thick line.
    pub fn capsule(&self, capsule: &Capsule, colour: RGBColor) -> Stroke {
        let width = (2.0 * capsule.radius * self.scale).round().max(1.0) as u32;
        let middle = nalgebra::center(&capsule.start, &capsule.end);
        let places = vec![self.place(&capsule.start), self.place(&capsule.end)];
        Stroke { places, width, colour, near: (middle - self.centre).dot(&self.towards) }
    }

    /// The edges of an obstacle.
    pub fn obstacle(&self, obstacle: &Obstacle, colour: RGBColor) -> Vec<Stroke> {
        let near = (Point3::from(obstacle.place.translation.vector) - self.centre).dot(&self.towards);
        let line = |points: &[Point3<f64>]| {
            let places = points.iter().map(|point| self.place(&(obstacle.place * point))).collect();
            Stroke { places, width: 1, colour, near }
        };
        match obstacle.solid {
            Solid::Box(size) => {
                let corner =
                    |x: f64, y: f64, z: f64| Point3::from(0.5 * Vector3::new(x, y, z).component_mul(&size));
                let round = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
                let face = |z: f64| line(&round.map(|(x, y)| corner(x, y, z)));
                let posts = round[..4].iter().map(|&(x, y)| line(&[corner(x, y, -1.0), corner(x, y, 1.0)]));
                [face(-1.0), face(1.0)].into_iter().chain(posts).collect()
            }
            Solid::Cylinder { radius, height } => {
                let point = |step: u32, z: f64| {
                    let turn = std::f64::consts::TAU * f64::from(step) / f64::from(CIRCLE);
                    Point3::new(radius * turn.cos(), radius * turn.sin(), 0.5 * z * height)
                };
                let ring = |z: f64| line(&(0..=CIRCLE).map(|step| point(step, z)).collect::<Vec<_>>());
                let post = |step: u32| line(&[point(step, -1.0), point(step, 1.0)]);
                vec![ring(-1.0), ring(1.0), post(0), post(CIRCLE / 3), post(2 * CIRCLE / 3)]
            }
            Solid::Capsule(capsule) => vec![self.capsule(&capsule.within(&obstacle.place), colour)],
        }
    }
}

/// Draws what is far first.
pub(crate) fn paint(sheet: &mut Sheet, mut strokes: Vec<Stroke>) {
    strokes.sort_by(|one, other| one.near.total_cmp(&other.near));
    for Stroke { places, width, colour, .. } in strokes {
        let ends = if width > 3 { vec![places[0], places[places.len() - 1]] } else { Vec::new() };
        sheet.path(places, colour, width);
        sheet.marks.extend(ends.into_iter().map(|end| coact_figures::Mark::Disc(end, width / 2, colour)));
    }
}
