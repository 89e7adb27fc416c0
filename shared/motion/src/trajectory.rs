use coact_robot::{JointLimits, MotionState, Posture, Quintic};
use std::f64::consts::{PI, TAU};

/// One movement of all joints in posture space: the direct movement of minimum jerk between two states and, when
/// something is in the way, an excursion towards a bounce posture, half-way through and back.
///
/// theta(s) = direct(s) + (theta_b - theta_0) g(s), g(s) = 4 s (1 - s) sin²(pi s), s = t / T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trajectory {
    /// State at the start.
    pub start: [MotionState; 7],
    /// State at the end.
    pub end: [MotionState; 7],
    /// theta_b - theta_0, rad: zero for a direct movement.
    pub bounce: Posture,
    /// T, s.
    pub duration: f64,
}

/// Instants at which a movement is held against the limits.
pub(crate) const CHECKED: usize = 64;

impl Trajectory {
    /// Positions at the share `s` of the time, rad.
    pub fn posture(&self, s: f64) -> Posture {
        let [g, ..] = excursion(s);
        std::array::from_fn(|joint| {
            self.direct(joint).at(s * self.duration).position + g * self.bounce[joint]
        })
    }

    /// State of all joints `t` s after the start; outside the movement the nearer end.
    pub fn at(&self, t: f64) -> [MotionState; 7] {
        let t = t.clamp(0.0, self.duration);
        let [g, slope, curve, _] = excursion(t / self.duration);
        std::array::from_fn(|joint| {
            let (direct, bounce) = (self.direct(joint).at(t), self.bounce[joint]);
            MotionState {
                position: direct.position + bounce * g,
                velocity: direct.velocity + bounce * slope / self.duration,
                acceleration: direct.acceleration + bounce * curve / self.duration.powi(2),
            }
        })
    }

    /// Jerk of all joints `t` s after the start, rad/s³.
    pub fn jerk(&self, t: f64) -> Posture {
        let t = t.clamp(0.0, self.duration);
        let [.., third] = excursion(t / self.duration);
        std::array::from_fn(|joint| {
            self.direct(joint).jerk(t) + self.bounce[joint] * third / self.duration.powi(3)
        })
    }

    /// Whether anything but the direct movement is needed.
    pub fn bounces(&self) -> bool {
        self.bounce.iter().any(|offset| *offset != 0.0)
    }

    fn direct(&self, joint: usize) -> Quintic {
        Quintic::new(self.start[joint], self.end[joint], self.duration)
    }

    /// A joint that breaks a limit on the way.
    pub(crate) fn broken(&self, limits: &[JointLimits; 7]) -> Option<usize> {
        (0..=CHECKED).find_map(|step| {
            let t = self.duration * step as f64 / CHECKED as f64;
            let (states, jerk) = (self.at(t), self.jerk(t));
            (0..7).find(|&joint| !limits[joint].allows(&states[joint], jerk[joint]))
        })
    }
}

/// g(s) and its first three derivatives by s.
pub(crate) fn excursion(s: f64) -> [f64; 4] {
    let (a, a1, a2) = (4.0 * s * (1.0 - s), 4.0 - 8.0 * s, -8.0);
    let (b, b1) = ((PI * s).sin().powi(2), PI * (TAU * s).sin());
    let (b2, b3) = (2.0 * PI * PI * (TAU * s).cos(), -4.0 * PI.powi(3) * (TAU * s).sin());
    [a * b, a1 * b + a * b1, a2 * b + 2.0 * a1 * b1 + a * b2, 3.0 * a2 * b1 + 3.0 * a1 * b2 + a * b3]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use proptest::prelude::*;

    fn states() -> impl Strategy<Value = [MotionState; 7]> {
        prop::array::uniform7((-1.0..1.0, -0.5..0.5, -2.0..2.0)).prop_map(|states| {
            states.map(|(position, velocity, acceleration)| MotionState { position, velocity, acceleration })
        })
    }

    proptest! {
        #[test]
        fn it_begins_and_ends_as_asked(start in states(), end in states(), bounce in prop::array::uniform7(-1.0..1.0)) {
            let trajectory = Trajectory { start, end, bounce, duration: 1.3 };
            for (found, wanted) in [(trajectory.at(0.0), start), (trajectory.at(1.3), end)] {
                for joint in 0..7 {
                    prop_assert!((found[joint].position - wanted[joint].position).abs() < 1e-9);
                    prop_assert!((found[joint].velocity - wanted[joint].velocity).abs() < 1e-9);
                    prop_assert!((found[joint].acceleration - wanted[joint].acceleration).abs() < 1e-8);
                }
            }
        }

        #[test]
        fn derivatives_agree_with_numeric_ones(
            start in states(), end in states(), bounce in prop::array::uniform7(-1.0..1.0), s in 0.05..0.95,
        ) {
            let trajectory = Trajectory { start, end, bounce, duration: 1.3 };
            let (t, h) = (1.3 * s, 1e-5);
            let (before, here, after) = (trajectory.at(t - h), trajectory.at(t), trajectory.at(t + h));
            let jerk = trajectory.jerk(t);
            for joint in 0..7 {
                let slope = |of: fn(&MotionState) -> f64| (of(&after[joint]) - of(&before[joint])) / (2.0 * h);
                prop_assert!((slope(|state| state.position) - here[joint].velocity).abs() < 1e-5);
                prop_assert!((slope(|state| state.velocity) - here[joint].acceleration).abs() < 1e-4);
                prop_assert!((slope(|state| state.acceleration) - jerk[joint]).abs() < 1e-3 * (1.0 + jerk[joint].abs()));
            }
        }
    }

    #[test]
    fn the_excursion_is_whole_half_way_and_smooth_at_both_ends() {
        assert!((excursion(0.5)[0] - 1.0).abs() < 1e-12 && excursion(0.5)[1].abs() < 1e-12);
        for end in [0.0, 1.0] {
            assert!(excursion(end)[..3].iter().all(|value| value.abs() < 1e-12));
        }
    }
}
