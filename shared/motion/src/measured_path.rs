use crate::Segment;
use crate::segment;
use coact_robot::{JointLimits, MotionState};

/// The path of all joints through segments, with its length. The length of a small change is that of the joints' changes, each in units of
/// its speed limit: so it is a time, s, and a path is the longer the more its joints have to do.
pub(crate) struct MeasuredPath<'a> {
    segments: &'a [Segment],
    /// Length up to points at equal steps of the segments' own time, s.
    covered: Vec<f64>,
    /// Its derivative by that time.
    speed: Vec<f64>,
    /// Time between two points, s.
    step: f64,
}

/// Where a path is at some length: the segments' own time, s, its speed there, and the derivative of that.
struct OwnTime {
    t: f64,
    speed: f64,
    change: f64,
}

/// Steps in which a path is measured. A trade-off with the time of planning.
const MEASURED: usize = 240;
/// Speeds below this count as zero: it only guards divisions.
const TINY_SPEED: f64 = 1e-9;

impl<'a> MeasuredPath<'a> {
    pub fn of(segments: &'a [Segment], limits: &[JointLimits; 7]) -> Self {
        let step = segment::duration(segments) / MEASURED as f64;
        let speed = (0..=MEASURED).map(|point| {
            let states = segment::states_at(segments, point as f64 * step);
            let parts = states.iter().zip(limits).map(|(state, limit)| state.velocity / limit.velocity);
            parts.map(|part| part.powi(2)).sum::<f64>().sqrt()
        });
        let speed: Vec<f64> = speed.collect();
        let mut covered = vec![0.0];
        for pair in speed.windows(2) {
            covered.push(covered[covered.len() - 1] + 0.5 * step * (pair[0] + pair[1]));
        }
        Self { segments, covered, speed, step }
    }

    /// The whole length, s.
    pub fn length(&self) -> f64 {
        self.covered[MEASURED]
    }

    /// Speed of the segments at their start, and its derivative.
    pub fn start(&self) -> MotionState {
        let change = (self.speed[1] - self.speed[0]) / self.step;
        MotionState { position: 0.0, velocity: self.speed[0], acceleration: change }
    }

    /// The length at an instant of the segments' own time, s.
    pub fn length_at(&self, own: f64) -> f64 {
        let from = ((own / self.step) as usize).min(MEASURED - 1);
        let (t, change) = (own - from as f64 * self.step, self.speed[from + 1] - self.speed[from]);
        (self.covered[from] + self.speed[from] * t + change / self.step * t * t / 2.0).min(self.length())
    }

    /// The segments' own time at this length, s.
    pub fn own_time(&self, length: f64) -> f64 {
        self.at(length).t
    }

    /// The speed of the segments at this length, in their own time.
    pub fn own_speed(&self, length: f64) -> f64 {
        self.at(length).speed
    }

    /// States of all joints where the path is covered so far and so fast: the chain rule.
    pub fn states_at(&self, length: MotionState) -> [MotionState; 7] {
        let OwnTime { t, speed, change } = self.at(length.position);
        let rate = length.velocity / speed.max(TINY_SPEED);
        let rate_change = (length.acceleration - change * rate * rate) / speed.max(TINY_SPEED);
        segment::states_at(self.segments, t).map(|state| MotionState {
            position: state.position,
            velocity: state.velocity * rate,
            acceleration: state.acceleration * rate * rate + state.velocity * rate_change,
        })
    }

    /// Between two points the speed is linear in time, so that a length is a quadratic.
    fn at(&self, length: f64) -> OwnTime {
        let to = self.covered.partition_point(|covered| *covered < length).clamp(1, MEASURED);
        let from = to - 1;
        let change = (self.speed[to] - self.speed[from]) / self.step;
        let rest = (length - self.covered[from]).max(0.0);
        let speed = (self.speed[from].powi(2) + 2.0 * change * rest).max(0.0).sqrt();
        let t = (2.0 * rest / (self.speed[from] + speed).max(TINY_SPEED)).min(self.step);
        OwnTime { t: from as f64 * self.step + t, speed: self.speed[from] + t * change, change }
    }
}
