use crate::path_bounds::{PathBounds, STEPS};
use coact_robot::MotionState;

/// The fastest scaling along a path under limits of speed and acceleration, whatever the jerk: backwards the highest speed from which each point's
/// can still be braked to, then forwards the most of that (Pham, Pham, IEEE Trans. Robot. 34, 2018). Between two points the acceleration is
/// constant.
pub(crate) struct TimeOptimalScaling {
    /// The first one is where the scaling begins.
    points: Vec<ScalingPoint>,
    /// Acceleration before that, 1/s.
    before: f64,
}

#[derive(Clone, Copy)]
struct ScalingPoint {
    /// Since the scaling's beginning, s.
    time: f64,
    /// Length of the path, s, and the speed along it, 1.
    length: f64,
    speed: f64,
    /// Acceleration up to the next point, 1/s.
    acceleration: f64,
    /// Integral of the length over time, s².
    sum: f64,
}

/// Speeds of two neighbouring points, together, below which the path is blocked.
const BLOCKED: f64 = 1e-6;

impl ScalingPoint {
    /// `t` s after the point.
    fn after(&self, t: f64) -> Self {
        let Self { time, length, speed, acceleration, sum } = *self;
        Self {
            time: time + t,
            length: length + speed * t + acceleration * t.powi(2) / 2.0,
            speed: speed + acceleration * t,
            acceleration,
            sum: sum + length * t + speed * t.powi(2) / 2.0 + acceleration * t.powi(3) / 6.0,
        }
    }
}

impl TimeOptimalScaling {
    /// From this length and speed on; none when it is too fast for what comes, or something blocks the path.
    pub fn of(bounds: &PathBounds, start: MotionState) -> Option<Self> {
        let step = bounds.step;
        if start.position >= step * STEPS as f64 {
            return None;
        }
        let mut squares = vec![0.0; STEPS + 1];
        for point in (0..STEPS).rev() {
            squares[point] = bounds.controllable(point, squares[point + 1]);
        }
        let next = ((start.position / step) as usize + 1).min(STEPS);
        let (mut square, mut from) = (start.velocity.powi(2), start.position);
        let mut points = vec![ScalingPoint {
            time: 0.0,
            length: from,
            speed: start.velocity,
            acceleration: 0.0,
            sum: 0.0,
        }];
        for (point, controllable) in squares.into_iter().enumerate().skip(next) {
            let (way, last) = (point as f64 * step - from, points.len() - 1);
            let (least, most) = bounds.accelerations(point - 1, square);
            let fastest = controllable.min(square + 2.0 * way * most.max(0.0));
            if fastest < square + 2.0 * way * least - 1e-9 && point == next {
                return None;
            }
            let (speed, reached) = (square.sqrt(), fastest.sqrt());
            if speed + reached < BLOCKED {
                return None;
            }
            let time = 2.0 * way / (speed + reached);
            points[last].acceleration = (reached - speed) / time;
            let arrived = points[last].after(time);
            points.push(ScalingPoint {
                length: point as f64 * step,
                speed: reached,
                acceleration: 0.0,
                ..arrived
            });
            (square, from) = (fastest, point as f64 * step);
        }
        let scaling = Self { points, before: start.acceleration };
        scaling.duration().is_finite().then_some(scaling)
    }

    /// When it is at the end, s.
    pub fn duration(&self) -> f64 {
        self.points[self.points.len() - 1].time
    }

    /// When it is at this point of the path, s; before the beginning, then.
    pub fn time_at(&self, length: f64) -> f64 {
        let next = self.points.partition_point(|point| point.length < length);
        self.points[next.min(self.points.len() - 1)].time
    }

    /// The mean of the length over a window around an instant, s, with its derivatives.
    pub fn mean(&self, t: f64, window: f64) -> MotionState {
        let (from, to) = (self.at(t - 0.5 * window), self.at(t + 0.5 * window));
        MotionState {
            position: (to.sum - from.sum) / window,
            velocity: (to.length - from.length) / window,
            acceleration: (to.speed - from.speed) / window,
        }
    }

    fn at(&self, t: f64) -> ScalingPoint {
        if t <= 0.0 {
            return ScalingPoint { acceleration: self.before, ..self.points[0] }.after(t);
        }
        let point = &self.points[self.points.partition_point(|point| point.time <= t).saturating_sub(1)];
        point.after(t - point.time)
    }
}
