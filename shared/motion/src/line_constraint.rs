use crate::{Mechanism, Segment, SegmentKind};
use coact_robot::Posture;
use nalgebra::{Matrix3, Point3, Vector3};

/// A constraint: the grasp point keeps to a straight line where the hand leaves something, or puts a part into its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LineConstraint {
    /// Index of the segment that it holds for.
    pub segment: usize,
    /// The inner end of the line: where the grasp point is inside, m, world.
    inside: Point3<f64>,
    /// Direction of the line from there, unit.
    out: Vector3<f64>,
    /// Its length, m.
    length: f64,
    tolerance: Tolerance,
}

/// How far the grasp point may be off its line: `inside` m at the inner end, and `opening` m more for each metre outside.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tolerance {
    inside: f64,
    opening: f64,
}

/// Where the hand leaves what it has let go. Chosen by hand: less than the gap of 10 mm between open fingers and part.
const LEAVING: Tolerance = Tolerance { inside: 0.004, opening: 0.2 };
/// Where the hand puts a part into its place. Chosen by hand; it suits the toy vehicle's sockets, and
/// is untested on tighter ones.
const ENTERING: Tolerance = Tolerance { inside: 0.002, opening: 0.1 };

impl LineConstraint {
    /// The line out of where these segments begin, along `out` and as long as it, m; none without length, or where the
    /// hand does not leave first.
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
        tolerance: Tolerance,
    ) -> Option<Self> {
        let inside = mechanism.arm.palm(inside) * mechanism.grasp_point();
        let length = out.norm();
        (length > 0.0).then(|| Self { segment, inside, out: out / length, length, tolerance })
    }

    /// How far the grasp point at `place` is off the line, m, world; none beyond the line's outer end.
    pub fn offset(&self, place: &Point3<f64>) -> Option<Vector3<f64>> {
        (self.outside(place) < self.length).then(|| self.across() * (place - self.inside))
    }

    /// The projection across the line.
    pub fn across(&self) -> Matrix3<f64> {
        Matrix3::identity() - self.out * self.out.transpose()
    }

    /// By how much the grasp point is farther off than it may be, m.
    pub fn excess(&self, place: &Point3<f64>) -> f64 {
        let allowed = self.tolerance.inside + self.tolerance.opening * self.outside(place).max(0.0);
        self.offset(place).map_or(0.0, |offset| (offset.norm() - allowed).max(0.0))
    }

    /// How far outside it is, m.
    fn outside(&self, place: &Point3<f64>) -> f64 {
        (place - self.inside).dot(&self.out)
    }
}
