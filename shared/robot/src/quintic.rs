use bytemuck::{Pod, Zeroable};

/// Position, velocity and acceleration of one joint at an instant; rad, rad/s, rad/s².
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct MotionState {
    /// Position, rad.
    pub position: f64,
    /// Velocity, rad/s.
    pub velocity: f64,
    /// Acceleration, rad/s².
    pub acceleration: f64,
}

impl MotionState {
    /// Standing still at `position`.
    pub fn at_rest(position: f64) -> Self {
        Self { position, velocity: 0.0, acceleration: 0.0 }
    }

    /// Whether velocity and acceleration are zero.
    pub fn is_at_rest(&self) -> bool {
        self.velocity == 0.0 && self.acceleration == 0.0
    }
}

/// The minimum-jerk movement of one joint between two states: the polynomial of fifth degree with these boundary
/// values ("direct movement" of planning in posture space).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quintic {
    duration: f64,
    /// Coefficients of s⁰..s⁵, s = t / duration.
    coefficients: [f64; 6],
}

impl Quintic {
    /// The movement from `start` to `end` in `duration` s (above zero).
    pub fn new(start: MotionState, end: MotionState, duration: f64) -> Self {
        let d = end.position - start.position;
        let (v0, v1) = (start.velocity * duration, end.velocity * duration);
        let half = 0.5 * duration * duration;
        let (a0, a1) = (start.acceleration * half, end.acceleration * half);
        let coefficients = [
            start.position,
            v0,
            a0,
            10.0 * d - 6.0 * v0 - 4.0 * v1 - 3.0 * a0 + a1,
            -15.0 * d + 8.0 * v0 + 7.0 * v1 + 3.0 * a0 - 2.0 * a1,
            6.0 * d - 3.0 * v0 - 3.0 * v1 - a0 + a1,
        ];
        Self { duration, coefficients }
    }

    /// Position `t` s after the start, as in [`at`](Self::at).
    #[inline]
    pub fn position(&self, t: f64) -> f64 {
        let s = (t / self.duration).clamp(0.0, 1.0);
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))))
    }

    /// State `t` s after the start; before the start and after the end it is that of start and end.
    pub fn at(&self, t: f64) -> MotionState {
        let s = (t / self.duration).clamp(0.0, 1.0);
        let [_, c1, c2, c3, c4, c5] = self.coefficients;
        let slope = c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)));
        let bend = 2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5));
        MotionState {
            position: self.position(t),
            velocity: slope / self.duration,
            acceleration: bend / (self.duration * self.duration),
        }
    }

    /// Jerk `t` s after the start, rad/s³.
    pub fn jerk(&self, t: f64) -> f64 {
        let s = (t / self.duration).clamp(0.0, 1.0);
        let [.., c3, c4, c5] = self.coefficients;
        (6.0 * c3 + s * (24.0 * c4 + s * 60.0 * c5)) / self.duration.powi(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn state() -> impl Strategy<Value = MotionState> {
        (-2.0..2.0, -1.5..1.5, -5.0..5.0).prop_map(|(position, velocity, acceleration)| MotionState {
            position,
            velocity,
            acceleration,
        })
    }

    proptest! {
        #[test]
        fn boundary_values_are_met(start in state(), end in state(), duration in 0.2..3.0) {
            let movement = Quintic::new(start, end, duration);
            for (found, wanted) in [(movement.at(0.0), start), (movement.at(duration), end)] {
                prop_assert!((found.position - wanted.position).abs() < 1e-9);
                prop_assert!((found.velocity - wanted.velocity).abs() < 1e-9);
                prop_assert!((found.acceleration - wanted.acceleration).abs() < 1e-8);
            }
        }

        #[test]
        fn derivatives_agree_with_numeric_ones(
            start in state(), end in state(), duration in 0.2..3.0, fraction in 0.1..0.9,
        ) {
            let movement = Quintic::new(start, end, duration);
            let (t, h) = (fraction * duration, 1e-4 * duration);
            let slope = |of: fn(&MotionState) -> f64| (of(&movement.at(t + h)) - of(&movement.at(t - h))) / (2.0 * h);
            let here = movement.at(t);
            let scale = 1.0 + movement.jerk(t).abs();
            prop_assert!((slope(|s| s.position) - here.velocity).abs() < 1e-5 * scale);
            prop_assert!((slope(|s| s.velocity) - here.acceleration).abs() < 1e-5 * scale);
            prop_assert!((slope(|s| s.acceleration) - movement.jerk(t)).abs() < 1e-3 * scale);
        }
    }
}
