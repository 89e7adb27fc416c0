use crate::measured_path::MeasuredPath;
use crate::plan::USED;
use crate::segment;
use crate::{HandSpeedLimits, Mechanism, Segment, SegmentKind};
use coact_robot::{JointLimits, Posture};
use nalgebra::Point3;

/// What the limits allow along a path: at each of its points a highest speed, and, at a speed, the least and the greatest acceleration.
pub(crate) struct PathBounds<'a> {
    limits: &'a [JointLimits; 7],
    /// Length between two points, s.
    pub step: f64,
    points: Vec<PathPoint>,
    /// Fraction of the joints' acceleration that may be used at each point.
    effort: Vec<f64>,
}

/// The path at one of its points: derivatives of the posture by length, and the square of the highest speed.
struct PathPoint {
    slope: Posture,
    bend: Posture,
    fastest: f64,
}

/// Steps of a path. A trade-off with the time of planning.
pub(crate) const STEPS: usize = 80;
/// Slopes (rad/s, m/s) below this count as zero: they only guard divisions.
const TINY: f64 = 1e-9;
/// An acceleration that no limit binds, 1/s.
const UNBOUND: f64 = 1e6;
/// Halvings by which the highest speed is found that can still be braked: to 1e-6 of it.
const HALVINGS: u32 = 20;
/// Least effort: so a scaling that is made anew is never at a stand.
const LEAST_EFFORT: f64 = 0.05;

impl<'a> PathBounds<'a> {
    /// Of the path through these segments. The hand keeps to its free speed, and to that of contact for so many m from where it leaves, and from where it
    /// arrives.
    pub fn of(
        mechanism: &Mechanism,
        segments: &[Segment],
        path: &MeasuredPath,
        limits: &'a [JointLimits; 7],
        (speeds, near): (&HandSpeedLimits, [f64; 2]),
    ) -> Self {
        let step = path.length() / STEPS as f64;
        let own: Vec<f64> = (0..=STEPS).map(|point| path.own_time(point as f64 * step)).collect();
        let posture = |own: &f64| segment::states_at(segments, *own).map(|state| state.position);
        let postures: Vec<Posture> = own.iter().map(posture).collect();
        let place = |posture: &Posture| mechanism.arm.palm(posture) * mechanism.grasp_point();
        let places: Vec<Point3<f64>> = postures.iter().map(place).collect();
        let hand_limit = |point: usize| {
            let (end, near) = match segment::during(segments, own[point]).map(|(segment, _)| segment.kind) {
                Some(SegmentKind::Leave) => (places[0], near[0]),
                Some(SegmentKind::Approach) => (places[STEPS], near[1]),
                Some(SegmentKind::Reach) | None => return speeds.free,
            };
            if (places[point] - end).norm() < near { speeds.contact } else { speeds.free }
        };
        let points = (0..=STEPS).map(|point| {
            let (before, after) = (point.saturating_sub(1), (point + 1).min(STEPS));
            let (middle, apart) = (point.clamp(1, STEPS - 1), (after - before) as f64 * step);
            let slope: Posture =
                std::array::from_fn(|joint| (postures[after][joint] - postures[before][joint]) / apart);
            let bend = std::array::from_fn(|joint| {
                let [before, here, after] = [middle - 1, middle, middle + 1].map(|at| postures[at][joint]);
                (after - 2.0 * here + before) / step.powi(2)
            });
            let hand = (places[after] - places[before]).norm() / apart;
            let fastest = |slope: f64, most: f64| USED * most / slope.abs().max(TINY);
            let joints = slope.iter().zip(limits).map(|(slope, limit)| fastest(*slope, limit.velocity));
            let fastest = joints.fold(fastest(hand, hand_limit(point)), f64::min);
            PathPoint { slope, bend, fastest: fastest.powi(2) }
        });
        Self { limits, step, points: points.collect(), effort: vec![1.0; STEPS + 1] }
    }

    /// How many times slower than in their own time the segments must be to keep to the highest speeds.
    pub fn slowing(&self, path: &MeasuredPath) -> f64 {
        let points = self.points.iter().enumerate();
        let over = points.map(|(point, at)| path.own_speed(point as f64 * self.step) / at.fastest.sqrt());
        over.fold(1.0, f64::max)
    }

    /// All of the joints' acceleration may be used again.
    pub fn restore(&mut self) {
        self.effort.fill(1.0);
    }

    /// At this point so many times less of the joints' acceleration may be used.
    pub fn ease(&mut self, point: usize, factor: f64) {
        self.effort[point] = (self.effort[point] / factor).max(LEAST_EFFORT);
    }

    /// The least and the greatest acceleration at a point, 1/s, with this square of the speed. There, the joint's is slope x acceleration + bend x square.
    pub fn accelerations(&self, point: usize, square: f64) -> (f64, f64) {
        let PathPoint { slope, bend, .. } = &self.points[point];
        let used = USED * self.effort[point];
        (0..7).filter(|joint| slope[*joint].abs() > TINY).fold((-UNBOUND, UNBOUND), |(least, most), joint| {
            let (limit, bent) = (used * self.limits[joint].acceleration, bend[joint] * square);
            let ends = [(-limit - bent) / slope[joint], (limit - bent) / slope[joint]];
            (least.max(ends[0].min(ends[1])), most.min(ends[0].max(ends[1])))
        })
    }

    /// The greatest square of the speed at a point from which the next one is reached with the square `next` at most.
    pub fn controllable(&self, point: usize, next: f64) -> f64 {
        let is_good = |square: f64| {
            let (least, most) = self.accelerations(point, square);
            least <= most && square + 2.0 * self.step * least <= next
        };
        let (mut low, mut high) = (0.0, self.points[point].fastest);
        if is_good(high) {
            return high;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_good(middle) { low = middle } else { high = middle }
        }
        low
    }
}
