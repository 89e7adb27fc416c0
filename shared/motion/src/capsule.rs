use nalgebra::{Isometry3, Point3, Vector3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::ClosestPoints;
use parry3d_f64::query::details::closest_points_segment_segment;
use parry3d_f64::shape::Segment;

/// All points within a radius of a line segment; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// One end of the line.
    pub start: Point3<f64>,
    /// Its other end.
    pub end: Point3<f64>,
    /// Radius.
    pub radius: f64,
}

/// Lengths of the inner line that are tried for a capsule of least volume. Chosen by hand: the volume is flat near its
/// minimum.
const LENGTHS: u32 = 32;
/// Smallest squared length of the inner line, m²: it only guards a division.
const TINY: f64 = 1e-18;

impl Capsule {
    /// The capsule of least volume around what reaches `half` along the z axis of `place` and `around` away
    /// from that axis.
    pub fn around(place: &Isometry3<f64>, half: f64, around: f64) -> Self {
        let enclosing = |step: u32| {
            let line = half * f64::from(step) / f64::from(LENGTHS);
            (line, around.hypot(half - line))
        };
        let volume = |(line, radius): (f64, f64)| radius * radius * (4.0 / 3.0 * radius + 2.0 * line);
        let least = (0..=LENGTHS).map(enclosing).min_by(|one, other| volume(*one).total_cmp(&volume(*other)));
        let (line, radius) = least.unwrap_or((half, around));
        let end = |sign: f64| place * Point3::new(0.0, 0.0, sign * line);
        Self { start: end(-1.0), end: end(1.0), radius }
    }

    /// Around a box with these edges, m, centred on `place`.
    pub fn around_box(place: &Isometry3<f64>, size: Vector3<f64>) -> Self {
        let long = size.imax();
        let (one, other) = (size[(long + 1) % 3], size[(long + 2) % 3]);
        let mut along = Vector3::zeros();
        along[long] = 1.0;
        let turn = nalgebra::UnitQuaternion::rotation_between(&Vector3::z(), &along).unwrap_or_default();
        Self::around(&(place * turn), 0.5 * size[long], 0.5 * one.hypot(other))
    }

    /// Around points, in the directions of their own axes-aligned box. None without points.
    pub fn around_points(points: &[Point3<f64>]) -> Option<Self> {
        let first = points.first()?;
        let corner = |pick: fn(f64, f64) -> f64| {
            points.iter().fold(first.coords, |corner, point| corner.zip_map(&point.coords, pick))
        };
        let (low, high) = (corner(f64::min), corner(f64::max));
        let centre = Isometry3::from_parts((0.5 * (low + high)).into(), Default::default());
        Some(Self::around_box(&centre, high - low))
    }

    /// The same capsule in the frame in which `frame` is given.
    pub fn within(&self, frame: &Isometry3<f64>) -> Self {
        Self { start: frame * self.start, end: frame * self.end, radius: self.radius }
    }

    /// Distance of a point from the capsule's line, m.
    pub fn distance_of_line(&self, point: &Point3<f64>) -> f64 {
        let line = self.end - self.start;
        let fraction = (point - self.start).dot(&line) / line.norm_squared().max(TINY);
        (point - (self.start + line * fraction.clamp(0.0, 1.0))).norm()
    }

    /// Distance of the surfaces of two capsules, m; negative when they overlap.
    pub fn distance(&self, other: &Self) -> f64 {
        let (mine, theirs) = self.nearest(other);
        (mine - theirs).norm() - self.radius - other.radius
    }

    /// The points of the lines of two capsules at which they are nearest to each other.
    pub fn nearest(&self, other: &Self) -> (Point3<f64>, Point3<f64>) {
        let segment = |capsule: &Self| {
            let [start, end] = [capsule.start, capsule.end].map(|at| Vector::new(at.x, at.y, at.z));
            Segment::new(start, end)
        };
        let (one, two) = (segment(self), segment(other));
        let point = |at: Vector| Point3::new(at.x, at.y, at.z);
        match closest_points_segment_segment(&Pose::IDENTITY, &one, &two, f64::INFINITY) {
            ClosestPoints::WithinMargin(mine, theirs) => (point(mine), point(theirs)),
            // With no bound on the distance there are always such points.
            ClosestPoints::Intersecting | ClosestPoints::Disjoint => (self.start, other.start),
        }
    }

    /// A distance, m, that two capsules have at least: from this line to a sphere around the other.
    pub fn least_distance(&self, other: &Self) -> f64 {
        let sphere = 0.5 * (other.end - other.start).norm() + other.radius;
        self.distance_of_line(&nalgebra::center(&other.start, &other.end)) - sphere - self.radius
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_box_lies_within_its_capsule(x in 0.01..0.5f64, y in 0.01..0.5f64, z in 0.01..0.5f64) {
            let capsule = Capsule::around_box(&Isometry3::translation(0.3, -0.2, 0.1), Vector3::new(x, y, z));
            for corner in 0..8 {
                let half = |bit: u32, size: f64| if corner & bit == 0 { 0.5 * size } else { -0.5 * size };
                let corner = Point3::new(0.3 + half(1, x), -0.2 + half(2, y), 0.1 + half(4, z));
                prop_assert!(capsule.distance_of_line(&corner) <= capsule.radius + 1e-9);
            }
        }
    }

    #[test]
    fn a_cube_becomes_a_ball_and_a_stick_a_stick() {
        let cube = Capsule::around_box(&Isometry3::identity(), Vector3::repeat(0.1));
        assert!((cube.end - cube.start).norm() < cube.radius);
        let stick = Capsule::around_box(&Isometry3::identity(), Vector3::new(1.0, 0.02, 0.02));
        assert!((stick.end - stick.start).norm() > 0.95 && stick.radius < 0.03);
    }
}
