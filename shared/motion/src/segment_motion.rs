use crate::plan::broken;
use coact_robot::{JointLimits, MotionState, Posture, Quintic};
use std::f64::consts::{PI, TAU};

/// The movement of all joints in one segment: the direct movement of minimum jerk between two states and, where something
/// blocks it, a bounce: towards a bounce posture, half-way through and back (Rosenbaum et al., Psychol. Rev. 108, 2001).
///
/// theta(s) = direct(s) + (theta_b - theta_0) g(s), g(s) = 4 s (1 - s) sin²(pi s), s = t / T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SegmentMotion {
    /// State at the start.
    pub start: [MotionState; 7],
    /// State at the end.
    pub end: [MotionState; 7],
    /// theta_b - theta_0, rad: zero for a direct movement.
    pub bounce: Posture,
    /// T, s.
    pub duration: f64,
}

/// Steps of time at whose ends limits are checked. Chosen by hand: fine against a bounce, which has two peaks of speed.
const CHECKED: usize = 64;

impl SegmentMotion {
    /// Positions at the fraction `s` of the duration, rad.
    pub fn posture(&self, s: f64) -> Posture {
        let direct = |joint: usize| self.direct(joint).position(s * self.duration);
        if !self.bounces() {
            return std::array::from_fn(direct);
        }
        let [g, ..] = bounce_profile(s);
        std::array::from_fn(|joint| direct(joint) + g * self.bounce[joint])
    }

    /// State of all joints `t` s after the start; outside the movement the nearer end.
    pub fn at(&self, t: f64) -> [MotionState; 7] {
        self.states(&self.all_direct(), t)
    }

    #[cfg(test)]
    /// Jerk of all joints `t` s after the start, rad/s³.
    pub fn jerk(&self, t: f64) -> Posture {
        self.jerks(&self.all_direct(), t)
    }

    /// States and jerks of all joints at equal steps of time, from the start to the end.
    pub(crate) fn samples(&self) -> impl Iterator<Item = ([MotionState; 7], Posture)> + '_ {
        let direct = self.all_direct();
        (0..=CHECKED).map(move |step| {
            let t = self.duration * step as f64 / CHECKED as f64;
            (self.states(&direct, t), self.jerks(&direct, t))
        })
    }

    fn states(&self, direct: &[Quintic; 7], t: f64) -> [MotionState; 7] {
        let t = t.clamp(0.0, self.duration);
        let mut states = direct.map(|direct| direct.at(t));
        if self.bounces() {
            let [g, first, second, _] = bounce_profile(t / self.duration);
            for (state, bounce) in states.iter_mut().zip(self.bounce) {
                state.position += bounce * g;
                state.velocity += bounce * first / self.duration;
                state.acceleration += bounce * second / self.duration.powi(2);
            }
        }
        states
    }

    fn jerks(&self, direct: &[Quintic; 7], t: f64) -> Posture {
        let t = t.clamp(0.0, self.duration);
        let mut jerks = direct.map(|direct| direct.jerk(t));
        if self.bounces() {
            let [.., third] = bounce_profile(t / self.duration);
            for (jerk, bounce) in jerks.iter_mut().zip(self.bounce) {
                *jerk += bounce * third / self.duration.powi(3);
            }
        }
        jerks
    }

    /// Whether anything but the direct movement is needed.
    pub fn bounces(&self) -> bool {
        self.bounce.iter().any(|offset| *offset != 0.0)
    }

    fn direct(&self, joint: usize) -> Quintic {
        Quintic::new(self.start[joint], self.end[joint], self.duration)
    }

    fn all_direct(&self) -> [Quintic; 7] {
        std::array::from_fn(|joint| self.direct(joint))
    }

    /// The first joint that breaks a limit.
    pub(crate) fn broken(&self, limits: &[JointLimits; 7]) -> Option<usize> {
        broken(self.samples(), limits)
    }
}

/// g(s) and its first three derivatives by s.
pub(crate) fn bounce_profile(s: f64) -> [f64; 4] {
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
            let trajectory = SegmentMotion { start, end, bounce, duration: 1.3 };
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
            let trajectory = SegmentMotion { start, end, bounce, duration: 1.3 };
            let (t, h) = (1.3 * s, 1e-5);
            let (before, here, after) = (trajectory.at(t - h), trajectory.at(t), trajectory.at(t + h));
            let jerk = trajectory.jerk(t);
            for joint in 0..7 {
                let derivative = |of: fn(&MotionState) -> f64| (of(&after[joint]) - of(&before[joint])) / (2.0 * h);
                prop_assert!((derivative(|state| state.position) - here[joint].velocity).abs() < 1e-5);
                prop_assert!((derivative(|state| state.velocity) - here[joint].acceleration).abs() < 1e-4);
                prop_assert!((derivative(|state| state.acceleration) - jerk[joint]).abs() < 1e-3 * (1.0 + jerk[joint].abs()));
            }
        }
    }

    #[test]
    fn the_bounce_is_whole_half_way_and_smooth_at_both_ends() {
        assert!((bounce_profile(0.5)[0] - 1.0).abs() < 1e-12 && bounce_profile(0.5)[1].abs() < 1e-12);
        for end in [0.0, 1.0] {
            assert!(bounce_profile(end)[..3].iter().all(|value| value.abs() < 1e-12));
        }
    }
}
