use crate::{JointLimits, MotionState, Quintic};

/// A point-to-point movement: several joints start together, move with minimum jerk, and come to rest together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointToPoint<const N: usize> {
    /// State of each joint at the start.
    pub start: [MotionState; N],
    /// Where each joint comes to rest, rad.
    pub target: [f64; N],
    /// Duration, s.
    pub duration: f64,
}

/// Fraction of each limit that a movement from rest uses. Chosen by hand: the rest is left for the servo.
const USED: f64 = 0.95;
/// Fraction of each limit that a movement under way may use: more, because it may start at a peak of the one before.
/// Chosen by hand.
const USED_UNDER_WAY: f64 = 0.98;
/// Shortest movement, s: it keeps the duration above zero where start and target coincide. Chosen by hand.
const SHORTEST_S: f64 = 0.1;
/// Steps at whose ends the limits of a movement under way are checked. Chosen by hand: what lies between them is within
/// what [`USED_UNDER_WAY`] leaves.
const CHECKED: usize = 24;
/// A movement under way is made longer by this factor until it keeps the limits, so many times at most: up to twenty times
/// as long. Chosen by hand: it is at most 8 % too long.
const LONGER: f64 = 1.08;
const LONGER_TRIES: u32 = 40;

impl<const N: usize> PointToPoint<N> {
    /// The shortest movement (under way: to 8 %) from `start` to rest at `target` within the limits; `None` when there is
    /// none that keeps them, as when a joint is so fast that it must overshoot a position limit. From rest there
    /// always is one, if `start` and `target` lie within the position limits.
    pub fn plan(start: [MotionState; N], target: [f64; N], limits: &[JointLimits; N]) -> Option<Self> {
        let shortest = (0..N).map(|joint| {
            let distance = (target[joint] - start[joint].position).abs();
            rest_to_rest_duration(distance, &limits[joint])
        });
        let mut duration = shortest.fold(SHORTEST_S, f64::max);
        if start.iter().all(MotionState::is_at_rest) {
            return Some(Self { start, target, duration });
        }
        for _ in 0..LONGER_TRIES {
            let movement = Self { start, target, duration };
            if movement.keeps(limits) {
                return Some(movement);
            }
            duration *= LONGER;
        }
        None
    }

    /// The same movement, slower by `factor` (at least 1); only for one that starts at rest.
    pub fn slower(mut self, factor: f64) -> Self {
        if self.start.iter().all(MotionState::is_at_rest) {
            self.duration *= factor.max(1.0);
        }
        self
    }

    /// State of all joints `t` s after the start.
    pub fn at(&self, t: f64) -> [MotionState; N] {
        std::array::from_fn(|joint| self.joint(joint).at(t))
    }

    fn joint(&self, joint: usize) -> Quintic {
        Quintic::new(self.start[joint], MotionState::at_rest(self.target[joint]), self.duration)
    }

    fn keeps(&self, limits: &[JointLimits; N]) -> bool {
        (0..N).all(|joint| {
            let (path, limit) = (self.joint(joint), &limits[joint]);
            (0..=CHECKED).all(|point| {
                let t = self.duration * point as f64 / CHECKED as f64;
                let state = path.at(t);
                limit.contain(state.position, 0.0)
                    && state.velocity.abs() <= USED_UNDER_WAY * limit.velocity
                    && state.acceleration.abs() <= USED_UNDER_WAY * limit.acceleration
                    && path.jerk(t).abs() <= USED_UNDER_WAY * limit.jerk
            })
        })
    }
}

/// Duration, s, of a minimum-jerk movement over `distance` rad from rest to rest. Its peaks are 15/8 D/T (velocity),
/// 10/√3 D/T² (acceleration) and 60 D/T³ (jerk).
fn rest_to_rest_duration(distance: f64, limits: &JointLimits) -> f64 {
    let by_velocity = 1.875 * distance / (USED * limits.velocity);
    let by_acceleration = (10.0 / 3f64.sqrt() * distance / (USED * limits.acceleration)).sqrt();
    let by_jerk = (60.0 * distance / (USED * limits.jerk)).cbrt();
    by_velocity.max(by_acceleration).max(by_jerk)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use proptest::prelude::*;

    const LIMITS: JointLimits =
        JointLimits { lower: -2.0, upper: 2.0, velocity: 2.0, effort: 1.0, acceleration: 10.0, jerk: 200.0 };

    fn peaks(movement: &PointToPoint<2>) -> (f64, f64, f64) {
        let mut peak = (0.0f64, 0.0f64, 0.0f64);
        for joint in 0..2 {
            let path = movement.joint(joint);
            for step in 0..=500 {
                let t = movement.duration * f64::from(step) / 500.0;
                let state = path.at(t);
                peak.0 = peak.0.max(state.velocity.abs());
                peak.1 = peak.1.max(state.acceleration.abs());
                peak.2 = peak.2.max(path.jerk(t).abs());
            }
        }
        peak
    }

    proptest! {
        #[test]
        fn movements_from_rest_keep_the_limits_and_use_one_of_them(
            from in -1.9..1.9, to in -1.9..1.9, other in -1.9..1.9,
        ) {
            let start = [MotionState::at_rest(from), MotionState::at_rest(0.0)];
            let movement = PointToPoint::plan(start, [to, other], &[LIMITS; 2]).unwrap();
            let (velocity, acceleration, jerk) = peaks(&movement);
            prop_assert!(velocity <= 2.0 && acceleration <= 10.0 && jerk <= 200.0);
            let used = (velocity / 2.0).max(acceleration / 10.0).max(jerk / 200.0);
            prop_assert!(used > 0.9 || movement.duration == SHORTEST_S, "slow: {used}");
        }

        #[test]
        fn movements_under_way_keep_the_limits_when_planned(
            from in -1.0..1.0, velocity in -1.5..1.5, acceleration in -6.0..6.0, to in -1.5..1.5,
        ) {
            let start = [MotionState { position: from, velocity, acceleration }, MotionState::at_rest(0.0)];
            if let Some(movement) = PointToPoint::plan(start, [to, 0.5], &[LIMITS; 2]) {
                let (velocity, acceleration, jerk) = peaks(&movement);
                prop_assert!(velocity <= 2.0 && acceleration <= 10.0 && jerk <= 200.0);
            }
        }
    }
}
