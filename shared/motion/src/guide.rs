use crate::{Mechanism, Segment, SegmentKind};
use coact_robot::Posture;
use nalgebra::{Matrix3, Point3, Vector3};

/// The line on which the hand leaves something, or goes into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Guide {
    /// The segment that it is for.
    pub segment: usize,
    /// Where the grasp point is inside, m.
    inside: Point3<f64>,
    /// The way out from there, unit.
    out: Vector3<f64>,
    /// Its length, m.
    length: f64,
    /// How far the hand may be off it.
    off: (f64, f64),
}

/// How far the hand may be off its line inside, m, and how much more for each metre outside: where it leaves what it has
/// let go, and where it puts something into its place.
const LEAVING: (f64, f64) = (0.004, 0.2);
const ENTERING: (f64, f64) = (0.002, 0.1);

impl Guide {
    /// The line out of where these segments begin, as long as `out`, m; none without length, or where the hand does not
    /// leave first.
    pub fn of_leaving(mechanism: &Mechanism, segments: &[Segment], out: Vector3<f64>) -> Option<Self> {
        let first = segments.first().filter(|first| first.kind == SegmentKind::Leave)?;
        Self::new(mechanism, 0, &first.motion.posture(0.0), out, LEAVING)
    }

    /// The line on which they end; `out` leads out of there.
    pub fn of_approach(mechanism: &Mechanism, segments: &[Segment], out: Vector3<f64>) -> Option<Self> {
        let last = segments.last().filter(|last| last.kind == SegmentKind::Approach)?;
        Self::new(mechanism, segments.len() - 1, &last.motion.posture(1.0), out, ENTERING)
    }

    fn new(
        mechanism: &Mechanism,
        segment: usize,
        inside: &Posture,
        out: Vector3<f64>,
        off: (f64, f64),
    ) -> Option<Self> {
        let inside = mechanism.arm.palm(inside) * mechanism.grasp_point();
        let length = out.norm();
        (length > 0.0).then(|| Self { segment, inside, out: out / length, length, off })
    }

    /// How far a place of the grasp point is off the line, m, world; none where the line has ended.
    pub fn aside(&self, place: &Point3<f64>) -> Option<Vector3<f64>> {
        (self.outside(place) < self.length).then(|| self.across() * (place - self.inside))
    }

    /// What of a vector is across the line.
    pub fn across(&self) -> Matrix3<f64> {
        Matrix3::identity() - self.out * self.out.transpose()
    }

    /// By how much it is farther off than it may be, m.
    pub fn excess(&self, place: &Point3<f64>) -> f64 {
        let allowed = self.off.0 + self.off.1 * self.outside(place).max(0.0);
        self.aside(place).map_or(0.0, |aside| (aside.norm() - allowed).max(0.0))
    }

    /// How far outside it is, m.
    fn outside(&self, place: &Point3<f64>) -> f64 {
        (place - self.inside).dot(&self.out)
    }
}
