use crate::face::{Face, arc};
use coact_drawing::{Mark, Place, RGBColor, Sheet};
use coact_motion::{Capsule, Obstacle, Solid};
use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;

/// Colour of the robot's arm.
pub const ARM: RGBColor = RGBColor(120, 140, 165);
/// Colour of its hand.
pub const HAND: RGBColor = RGBColor(60, 80, 110);
/// Colour of what stands around.
pub const THINGS: RGBColor = RGBColor(190, 150, 90);

/// How the scene is seen: without perspective, from one direction.
#[derive(Debug, Clone, Copy)]
pub struct View {
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

/// What is drawn of an object, and how near it is to the eye.
#[derive(Debug, Clone)]
pub struct Silhouette {
    places: Vec<Place>,
    form: Form,
    colour: RGBColor,
    near: f64,
}

#[derive(Debug, Clone, Copy)]
enum Form {
    /// A line of this width, pixels.
    Line(u32),
    /// A line of this width with round ends and a darker edge.
    Capsule(u32),
    Area,
}

/// Straight pieces of a third of a circle: enough that it looks round.
const THIRD: u32 = 8;
/// Brightness of a face that looks away from the light, and how much brighter one is that looks towards it. For the eye only.
const SHADE: (f64, f64) = (0.72, 0.28);
/// Direction towards the light: right, up, and towards the eye.
const LIGHT: [f64; 3] = [0.3, 0.8, 0.5];

impl View {
    /// From the direction `towards` the eye, such that all of this fits into a picture of a size in pixels.
    pub fn of(capsules: &[Capsule], towards: Vector3<f64>, size: [i32; 2]) -> Self {
        let towards = towards.normalize();
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

    /// The same view in another picture.
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
    pub fn capsule(&self, capsule: &Capsule, colour: RGBColor) -> Silhouette {
        let width = (2.0 * capsule.radius * self.scale).round().max(2.0) as u32;
        let middle = nalgebra::center(&capsule.start, &capsule.end);
        let places = vec![self.place(&capsule.start), self.place(&capsule.end)];
        Silhouette { places, form: Form::Capsule(width), colour, near: self.near(&middle) }
    }

    /// The faces of an obstacle that look at the eye, shaded.
    pub fn solid(&self, obstacle: &Obstacle, colour: RGBColor) -> Vec<Silhouette> {
        if let Solid::Capsule(capsule) = obstacle.solid {
            return vec![self.capsule(&capsule.within(&obstacle.place), colour)];
        }
        let near = self.near(&Point3::from(obstacle.place.translation.vector));
        let light = (self.right * LIGHT[0] + self.up * LIGHT[1] + self.towards * LIGHT[2]).normalize();
        let seen = |face: Face| {
            let normal = obstacle.place * face.normal;
            let places = face.corners.iter().map(|corner| self.place(&(obstacle.place * corner))).collect();
            let shade = SHADE.0 + SHADE.1 * normal.dot(&light).max(0.0);
            let colour = shaded(colour, shade);
            (normal.dot(&self.towards) > 0.0).then_some(Silhouette { places, form: Form::Area, colour, near })
        };
        let eye = obstacle.place.inverse() * self.towards;
        Face::of(&obstacle.solid, &eye).into_iter().filter_map(seen).collect()
    }

    /// The edges of an obstacle.
    pub fn edges(&self, obstacle: &Obstacle, colour: RGBColor) -> Vec<Silhouette> {
        let near = self.near(&Point3::from(obstacle.place.translation.vector));
        let line = |points: &[Point3<f64>]| {
            let places = points.iter().map(|point| self.place(&(obstacle.place * point))).collect();
            Silhouette { places, form: Form::Line(1), colour, near }
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
                let [below, above] = [-0.5, 0.5]
                    .map(|side| arc(radius, side * height, (0.0, TAU), 3 * THIRD).collect::<Vec<_>>());
                let post = |third: usize| {
                    let at = third * THIRD as usize;
                    line(&[below[at], above[at]])
                };
                vec![line(&below), line(&above), post(0), post(1), post(2)]
            }
            Solid::Capsule(capsule) => vec![self.capsule(&capsule.within(&obstacle.place), colour)],
        }
    }

    fn near(&self, point: &Point3<f64>) -> f64 {
        (point - self.centre).dot(&self.towards)
    }
}

/// Draws silhouettes, the farthest first.
pub fn paint(sheet: &mut Sheet, mut silhouettes: Vec<Silhouette>) {
    silhouettes.sort_by(|one, other| one.near.total_cmp(&other.near));
    for Silhouette { places, form, colour, .. } in silhouettes {
        match form {
            Form::Area => sheet.area(places, colour),
            Form::Line(width) => sheet.path(places, colour, width),
            Form::Capsule(width) => {
                rounded_line(sheet, &places, width + 2, shaded(colour, 0.6));
                rounded_line(sheet, &places, width, colour);
            }
        }
    }
}

fn rounded_line(sheet: &mut Sheet, places: &[Place], width: u32, colour: RGBColor) {
    sheet.path(places, colour, width);
    sheet.marks.extend(places.iter().map(|end| Mark::Disc(*end, width / 2, colour)));
}

/// A colour with this fraction of its brightness.
fn shaded(RGBColor(red, green, blue): RGBColor, brightness: f64) -> RGBColor {
    let part = |value: u8| (f64::from(value) * brightness).round() as u8;
    RGBColor(part(red), part(green), part(blue))
}
