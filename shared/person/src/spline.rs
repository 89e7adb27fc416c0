/// Coordinates of shoulder, elbow and wrist, one after the other.
pub(crate) type Row = [f64; 9];

/// A natural cubic spline: the curve of least curvature through all samples. Its acceleration is continuous, so that none is
/// invented between the samples, as straight lines would with a kick at each of them.
///
/// (Crates that interpolate have none with continuous acceleration through samples at unequal times; it is one band matrix.)
#[derive(Debug, Clone)]
pub(crate) struct Spline {
    knots: Vec<SplineKnot>,
}

/// A sample that it goes through.
#[derive(Debug, Clone, Copy)]
struct SplineKnot {
    time: f64,
    value: Row,
    /// Second derivative.
    curvature: Row,
}

impl Spline {
    /// Through samples whose times ascend; two at least.
    pub fn through(samples: impl Iterator<Item = (f64, Row)>) -> Self {
        let knot = |(time, value)| SplineKnot { time, value, curvature: [0.0; 9] };
        let mut knots: Vec<SplineKnot> = samples.map(knot).collect();
        // The matrix has three diagonals (Press et al., Numerical Recipes, 3.3); eliminated forwards, solved backwards.
        let mut above = vec![0.0; knots.len()];
        for index in 1..knots.len().saturating_sub(1) {
            let [before, now, after] = [knots[index - 1], knots[index], knots[index + 1]];
            let (one, other) = (now.time - before.time, after.time - now.time);
            let pivot = 2.0 * (one + other) - one * above[index - 1];
            above[index] = other / pivot;
            knots[index].curvature = std::array::from_fn(|axis| {
                let bend = (after.value[axis] - now.value[axis]) / other
                    - (now.value[axis] - before.value[axis]) / one;
                (6.0 * bend - one * before.curvature[axis]) / pivot
            });
        }
        for index in (1..knots.len().saturating_sub(1)).rev() {
            let after = knots[index + 1].curvature;
            for (own, after) in knots[index].curvature.iter_mut().zip(after) {
                *own -= above[index] * after;
            }
        }
        Self { knots }
    }

    /// From the first sample to the last, s.
    pub fn duration(&self) -> f64 {
        match (self.knots.first(), self.knots.last()) {
            (Some(first), Some(last)) => last.time - first.time,
            _ => 0.0,
        }
    }

    /// Value and velocity so many seconds after the first sample.
    pub fn at(&self, elapsed: f64) -> (Row, Row) {
        let Some(first) = self.knots.first() else { return ([0.0; 9], [0.0; 9]) };
        let time = first.time + elapsed.clamp(0.0, self.duration());
        let next = self.knots.partition_point(|knot| knot.time <= time).clamp(1, self.knots.len() - 1);
        let (from, to) = (self.knots[next - 1], self.knots[next]);
        let span = to.time - from.time;
        let (left, right) = ((to.time - time) / span, (time - from.time) / span);
        let bend = |fraction: f64| (fraction * fraction - 1.0) * fraction * span * span / 6.0;
        let slope = |fraction: f64| (3.0 * fraction * fraction - 1.0) * span / 6.0;
        let value = |axis: usize| {
            left * from.value[axis]
                + right * to.value[axis]
                + bend(left) * from.curvature[axis]
                + bend(right) * to.curvature[axis]
        };
        let velocity = |axis: usize| {
            (to.value[axis] - from.value[axis]) / span - slope(left) * from.curvature[axis]
                + slope(right) * to.curvature[axis]
        };
        (std::array::from_fn(value), std::array::from_fn(velocity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(value: f64) -> Row {
        std::array::from_fn(|axis| value * (axis + 1) as f64)
    }

    /// Samples at unequal times, as when some were lost.
    fn waves() -> Spline {
        let times = (0..200).filter(|index| index % 7 != 3).map(|index| 0.01 * f64::from(index));
        Spline::through(times.map(|time| (time, row((3.0 * time).sin()))))
    }

    #[test]
    fn it_goes_through_its_samples_and_follows_the_movement_between_them() {
        let spline = waves();
        assert!((spline.duration() - 1.98).abs() < 1e-12);
        // Near its ends, where it is straight, a natural spline is not exact.
        for step in 100..1_890 {
            let time = 0.001 * f64::from(step);
            let (value, velocity) = spline.at(time);
            assert!((value[0] - (3.0 * time).sin()).abs() < 1e-6, "{time} s: {}", value[0]);
            assert!((velocity[8] - 27.0 * (3.0 * time).cos()).abs() < 1e-2, "{time} s: {}", velocity[8]);
        }
    }

    #[test]
    fn it_invents_no_acceleration() {
        let spline = waves();
        for step in 100..1_890 {
            let at = |step: i32| spline.at(0.001 * f64::from(step)).0[0];
            let acceleration = 1e6 * (at(step + 1) - 2.0 * at(step) + at(step - 1));
            assert!(acceleration.abs() < 9.1, "{step} ms: {acceleration}");
        }
    }
}
