use crate::{Mechanism, Segment, SegmentKind};
use coact_robot::Posture;
use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

/// A constraint: the hand keeps to a straight line where it leaves something, or puts a part into its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LineConstraint {
    /// Index of the segment that it holds for.
    pub segment: usize,
    /// The inner end of the line: where the grasp point is inside, m, world.
    inside: Point3<f64>,
    /// Direction of the line from there, unit.
    out: Vector3<f64>,
    /// Its length, m.
    length: f64,
    /// What keeps to it, in the palm: the grasp point first.
    points: Vec<Point3<f64>>,
    tolerance: Tolerance,
}

/// How far a point of the hand may be off its line: `inside` m at the inner end, and `opening` m more for each metre outside. Where
/// the hand is to keep its turn, too, a second point `lever` m farther out keeps to the line as well.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tolerance {
    inside: f64,
    opening: f64,
    lever: Option<f64>,
}

/// Where the hand leaves what it has let go. Chosen by hand: less than the gap of 10 mm between open fingers and part.
const LEAVING: Tolerance = Tolerance { inside: 0.004, opening: 0.2, lever: None };
/// Where the hand puts a part into its place. Chosen by hand: where a wheel of the toy vehicle meets the end of its axle, 51 mm
/// before its place, the hand may be 3 mm aside and turned by 3 degrees. A part may be 8 mm and 8 degrees off there, and how it
/// lies in the hand takes its share. Untested on tighter places.
const ENTERING: Tolerance = Tolerance { inside: 0.002, opening: 0.02, lever: Some(0.1) };

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
        let (palm, length) = (mechanism.arm.palm(inside), out.norm());
        let (grasp_point, out) = (mechanism.grasp_point(), out.try_normalize(0.0)?);
        let farther_out = |lever: f64| grasp_point + palm.inverse_transform_vector(&(lever * out));
        let points = std::iter::once(grasp_point).chain(tolerance.lever.map(farther_out)).collect();
        Some(Self { segment, inside: palm * grasp_point, out, length, points, tolerance })
    }

    /// Where the points of a hand are that keep to the line, m, world; none once the grasp point is beyond the line's outer end.
    pub fn places(&self, palm: &Isometry3<f64>) -> impl Iterator<Item = Point3<f64>> {
        let points = if self.outside(palm) < self.length { &self.points[..] } else { &[] };
        points.iter().map(move |point| palm * point)
    }

    /// How far one of them is off the line, m, world.
    pub fn offset(&self, place: &Point3<f64>) -> Vector3<f64> {
        self.across() * (place - self.inside)
    }

    /// The projection across the line.
    pub fn across(&self) -> Matrix3<f64> {
        Matrix3::identity() - self.out * self.out.transpose()
    }

    /// By how much one of them is farther off than it may be, m.
    pub fn excess(&self, palm: &Isometry3<f64>) -> f64 {
        let allowed = self.tolerance.inside + self.tolerance.opening * self.outside(palm).max(0.0);
        self.places(palm).fold(0.0, |excess: f64, place| excess.max(self.offset(&place).norm() - allowed))
    }

    /// How far outside the grasp point is, m.
    fn outside(&self, palm: &Isometry3<f64>) -> f64 {
        (palm * self.points[0] - self.inside).dot(&self.out)
    }
}
