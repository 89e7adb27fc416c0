use crate::JointLimits;

/// Stands before a joint's servo: lets a setpoint pass only if the joint can still be stopped from there within all limits,
/// and brakes otherwise.
///
/// Velocity and acceleration are the first and second differences of the setpoints themselves, so that the limits hold
/// for what is sent, cycle by cycle. Invariant: from the present state, braking ([`Limiter::brake`]) comes to rest
/// within position, velocity, acceleration and jerk limits. A candidate is accepted only if the state after it has
/// that property; braking keeps it. So, from a start at rest within the limits, no input can break them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limiter {
    /// Setpoint, rad.
    pub position: f64,
    /// First difference of the setpoints, rad/s.
    pub velocity: f64,
    /// Second difference, rad/s².
    pub acceleration: f64,
}

/// Bounds on braking in one direction, until rest.
struct BrakingBound {
    /// Largest speed, rad/s.
    peak: f64,
    /// Distance, rad.
    distance: f64,
}

/// Velocity (rad/s) and acceleration (rad/s²) below which a joint stands still: in one cycle of 1 ms it moves by less than
/// a picoradian.
const STILL_VELOCITY: f64 = 1e-9;
const STILL_ACCELERATION: f64 = 1e-6;
/// Fraction of the acceleration and jerk limits that braking uses: what is left is for rounding.
const USED: f64 = 1.0 - 1e-9;
/// Braking is followed for so many times the longest time that it can take in theory, and so many cycles more, before it
/// counts as endless. Chosen by hand, twice what is needed.
const PATIENCE: f64 = 2.0;
const EXTRA_CYCLES: usize = 8;

impl Limiter {
    /// At rest at `position` rad.
    pub fn at_rest(position: f64) -> Self {
        Self { position, velocity: 0.0, acceleration: 0.0 }
    }

    /// Whether the setpoint stands still.
    pub fn is_at_rest(&self) -> bool {
        self.velocity == 0.0 && self.acceleration == 0.0
    }

    /// The state after moving to `setpoint` within one cycle of `dt` s, if that is allowed.
    pub fn accept(&self, setpoint: f64, limits: &JointLimits, dt: f64) -> Option<Self> {
        let velocity = (setpoint - self.position) / dt;
        let acceleration = (velocity - self.velocity) / dt;
        let jerk = (acceleration - self.acceleration) / dt;
        let next = Self { position: setpoint, velocity, acceleration };
        let allowed = jerk.abs() <= limits.jerk && next.can_stop(limits, dt);
        allowed.then_some(next)
    }

    /// The state after one cycle of braking, in the fewest cycles that the limits of acceleration and jerk allow.
    pub fn brake(&self, limits: &JointLimits, dt: f64) -> Self {
        let Self { position, velocity, acceleration } = self;
        let acceleration =
            towards_zero(*velocity, *acceleration, USED * limits.acceleration, USED * limits.jerk, dt);
        let (position, velocity) = (*position, velocity + dt * acceleration);
        if velocity.abs() < STILL_VELOCITY && acceleration.abs() < STILL_ACCELERATION {
            return Self::at_rest(position);
        }
        Self { position: position + dt * velocity, velocity, acceleration }
    }

    /// A bound on the time in which braking from here ends, s: what is accelerating becomes a little faster first, then all speed
    /// is taken away.
    pub fn stops_in(&self, limits: &JointLimits) -> f64 {
        let (velocity, pull) = (self.velocity.abs(), self.acceleration.abs());
        pull / limits.jerk + time_to_rest(velocity + pull.powi(2) / (2.0 * limits.jerk), limits)
    }

    /// Whether this state keeps the limits and braking from here does, until rest. A bound on the braking distance decides
    /// where it can, else the braking is carried out.
    fn can_stop(&self, limits: &JointLimits, dt: f64) -> bool {
        self.keeps(limits) && (self.surely_stops(limits, dt) || self.stops_within(limits, dt))
    }

    fn surely_stops(&self, limits: &JointLimits, dt: f64) -> bool {
        let (up, down) = (self.braking_bound(1.0, limits, dt), self.braking_bound(-1.0, limits, dt));
        up.peak.max(down.peak) <= limits.velocity
            && self.position + up.distance <= limits.upper
            && self.position - down.distance >= limits.lower
    }

    /// A bound on how fast and how far braking from here goes on in the direction `sign`.
    ///
    /// Where the acceleration passes through zero, the speed in that direction is at most v + a²/2J; from there the
    /// symmetric movement to rest, of constant jerk, takes [`time_to_rest`] T and half of v T.
    /// Each term is enlarged for the steps of the discrete braking.
    fn braking_bound(&self, sign: f64, limits: &JointLimits, dt: f64) -> BrakingBound {
        let (velocity, acceleration) = (sign * self.velocity, sign * self.acceleration);
        let pull = acceleration.max(0.0);
        let step = dt * dt * limits.jerk;
        let room = 2.0 * dt * acceleration.abs() + step;
        let gain = acceleration.powi(2) / (2.0 * limits.jerk);
        let peak = (velocity + if pull > 0.0 { gain } else { 0.0 } + room).max(step);
        let from = (velocity + gain + room).max(step);
        let time = time_to_rest(from, limits);
        BrakingBound { peak, distance: from * (0.5 * time + pull / limits.jerk + 4.0 * dt) }
    }

    fn stops_within(&self, limits: &JointLimits, dt: f64) -> bool {
        let mut state = *self;
        let longest = limits.velocity / limits.acceleration + 4.0 * limits.acceleration / limits.jerk;
        for _ in 0..(PATIENCE * longest / dt) as usize + EXTRA_CYCLES {
            if state.is_at_rest() {
                return true;
            }
            state = state.brake(limits, dt);
            if !state.keeps(limits) {
                return false;
            }
        }
        state.is_at_rest()
    }

    fn keeps(&self, limits: &JointLimits) -> bool {
        limits.contain(self.position, 0.0)
            && self.velocity.abs() <= limits.velocity
            && self.acceleration.abs() <= limits.acceleration
    }
}

/// Time from a speed (rad/s) to rest, s, without acceleration at both ends: v/A + A/J, or 2 √(v/J) when A is not reached.
fn time_to_rest(speed: f64, limits: &JointLimits) -> f64 {
    let settling = limits.acceleration / limits.jerk;
    if speed < limits.acceleration * settling {
        2.0 * (speed / limits.jerk).sqrt()
    } else {
        speed / limits.acceleration + settling
    }
}

/// The rate, after a cycle of `dt` s, of a `value` that goes to zero in the fewest cycles and arrives there with rate zero:
/// discrete time-optimal feedback (fhan, J. Han, IEEE Trans. Ind. Electron. 56, 2009) with the rate bounded by `most`, and
/// its change by `most_change` a second.
pub fn towards_zero(value: f64, rate: f64, most: f64, most_change: f64, dt: f64) -> f64 {
    let change = time_optimal(value - dt * rate, rate, most_change, dt);
    (rate + dt * change).clamp(-most, most)
}

/// Han's discrete time-optimal feedback (fhan): the input u, |u| <= r, that takes x1' = x2, x2' = u to the origin in the
/// fewest steps of h s, without chatter.
fn time_optimal(x1: f64, x2: f64, r: f64, h: f64) -> f64 {
    let d = r * h * h;
    let a0 = h * x2;
    let y = x1 + a0;
    let a1 = (d * (d + 8.0 * y.abs())).sqrt();
    let a2 = a0 + y.signum() * (a1 - d) / 2.0;
    let a = if y.abs() <= d { a0 + y } else { a2 };
    if a.abs() <= d { -r * a / d } else { -r * a.signum() }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use proptest::prelude::*;

    const DT: f64 = coact_period::PERIOD_S;

    fn limits() -> impl Strategy<Value = JointLimits> {
        (0.2..3.0f64, 0.5..4.0, 2.0..20.0, 30.0..500.0).prop_map(|(half, velocity, acceleration, jerk)| {
            JointLimits { lower: -half, upper: half, velocity, effort: 1.0, acceleration, jerk }
        })
    }

    /// Setpoints that a limiter must bear: jumps, ramps, beyond the limits, nothing, not a number.
    fn setpoint(kind: u8, value: f64, cycle: usize, state: &Limiter) -> f64 {
        match kind % 6 {
            0 => 4.0 * value,
            1 => state.position + 0.002 * value,
            2 => state.position + DT * (state.velocity + DT * (state.acceleration + DT * 400.0 * value)),
            3 => (cycle as f64 * 0.01 * value).sin() * 3.0,
            4 => f64::NAN,
            _ => state.position + DT * (state.velocity + DT * (state.acceleration + 0.49)),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn braking_ends_within_its_bound(limits in limits(), setpoints in prop::collection::vec((any::<u8>(), -1.0..1.0), 60)) {
            let mut state = Limiter::at_rest(0.0);
            for (cycle, (kind, value)) in setpoints.into_iter().enumerate() {
                let wish = setpoint(kind, value, cycle, &state);
                state = state.accept(wish, &limits, DT).unwrap_or_else(|| state.brake(&limits, DT));
            }
            let bound = state.stops_in(&limits);
            let mut cycles = 0.0;
            while !state.is_at_rest() {
                state = state.brake(&limits, DT);
                cycles += 1.0;
            }
            // Braking goes in steps: up to as many more as the ramps of the acceleration have corners.
            prop_assert!(cycles * DT <= bound + 8.0 * DT, "{cycles} cycles, {bound} s");
        }

        #[test]
        fn no_setpoint_breaks_the_limits(limits in limits(), setpoints in prop::collection::vec((any::<u8>(), -1.0..1.0), 60)) {
            let mut state = Limiter::at_rest(0.0);
            for cycle in 0..3000 {
                let (kind, value) = setpoints[cycle / 50];
                let before = state;
                let setpoint = setpoint(kind, value, cycle, &state);
                state = state.accept(setpoint, &limits, DT).unwrap_or_else(|| state.brake(&limits, DT));
                let velocity = (state.position - before.position) / DT;
                let jerk = (state.acceleration - before.acceleration) / DT;
                prop_assert!((velocity - state.velocity).abs() < 1e-9);
                prop_assert!(limits.contain(state.position, 0.0), "position {}", state.position);
                prop_assert!(state.velocity.abs() <= limits.velocity);
                prop_assert!(state.acceleration.abs() <= limits.acceleration);
                // What is slower than standing still is taken for it: the last step is one of less than that.
                let allowed = limits.jerk * (1.0 + 1e-6) + STILL_ACCELERATION / DT;
                prop_assert!(jerk.abs() <= allowed, "jerk {jerk} of {}", limits.jerk);
            }
        }

        #[test]
        fn braking_stays_within_its_bound(limits in limits(), velocity in -1.0..1.0, acceleration in -1.0..1.0) {
            let acceleration = acceleration * limits.acceleration;
            let start = Limiter { position: 0.0, velocity: velocity * limits.velocity, acceleration };
            let bounds = [1.0, -1.0].map(|sign| start.braking_bound(sign, &limits, DT));
            let mut state = start;
            while !state.is_at_rest() {
                state = state.brake(&limits, DT);
                for (sign, bound) in [1.0, -1.0].iter().zip(&bounds) {
                    prop_assert!(sign * state.velocity <= bound.peak, "{} of {}", state.velocity, bound.peak);
                    prop_assert!(sign * state.position <= bound.distance, "{} of {}", state.position, bound.distance);
                }
            }
        }

        #[test]
        fn braking_ends_at_rest(limits in limits(), velocity in -1.0..1.0, acceleration in -1.0..1.0) {
            let acceleration = acceleration * limits.acceleration;
            let start = Limiter { position: 0.0, velocity: velocity * limits.velocity, acceleration };
            let mut state = start;
            let mut cycles = 0;
            while !state.is_at_rest() {
                state = state.brake(&limits, DT);
                cycles += 1;
                prop_assert!(cycles < 10_000, "still {state:?}");
            }
            // Time-optimal braking takes at most v/A + 2 A/J, after undoing the acceleration it starts with.
            let worst = start.velocity.abs() / limits.acceleration + 4.0 * limits.acceleration / limits.jerk;
            prop_assert!(f64::from(cycles) * DT < 1.5 * worst + 0.02, "{cycles} cycles, {worst} s");
        }
    }

    #[test]
    fn a_movement_within_the_limits_passes_unchanged() {
        let limits = JointLimits {
            lower: -1.0,
            upper: 1.0,
            velocity: 2.0,
            effort: 1.0,
            acceleration: 10.0,
            jerk: 200.0,
        };
        let start = [crate::MotionState::at_rest(-0.9)];
        let movement = crate::PointToPoint::plan(start, [0.97], &[limits]).unwrap();
        let mut state = Limiter::at_rest(-0.9);
        let mut cycle = 0;
        while cycle as f64 * DT < movement.duration {
            cycle += 1;
            let [setpoint] = movement.at(cycle as f64 * DT);
            state = state.accept(setpoint.position, &limits, DT).unwrap();
        }
        assert!((state.position - 0.97).abs() < 1e-12);
        assert!(state.velocity.abs() < 1e-2);
    }
}
