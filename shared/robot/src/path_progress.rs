use crate::{JointLimits, Knot, jerk_at, state_at, towards_zero};
use bytemuck::{Pod, Zeroable};

/// How far the arm has come along its trajectory, and how fast it goes on there.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct PathProgress {
    /// Time of the trajectory, s.
    pub elapsed: f64,
    /// Speed override: fraction of its planned speed at which it goes on, 0 to 1.
    pub speed_override: f64,
    /// Change of that, 1/s.
    pub override_rate: f64,
}

/// By how much the speed override may change without a joint breaking its limits.
struct OverrideLimits {
    /// Most that it may fall, and rise, 1/s.
    falling: f64,
    rising: f64,
    /// Most that that rate may change now, down and up, 1/s²; and when the trajectory itself needs no jerk.
    change: (f64, f64),
    usual_change: f64,
}

/// Fraction of the joints' acceleration and jerk that a change of the override uses. Chosen by hand: the rest is for what
/// the trajectory needs in the next cycles, which the present ones do not tell.
const USED: f64 = 0.9;
/// Fraction of that jerk with which the end of a change is foreseen. Chosen by hand: a joint that the trajectory makes faster
/// meanwhile can bear less by then.
const FORESEEN: f64 = 0.7;
/// Where the trajectory stands almost still, the override may change at most so fast, 1/s, and so suddenly, 1/s². Chosen by
/// hand: far more than a moving arm can bear.
const MOST_RATE: f64 = 50.0;
const MOST_CHANGE: f64 = 5000.0;
/// An override this near to the wanted one, at this rate, 1/s, has arrived.
const ARRIVED: (f64, f64) = (1e-4, 1e-2);
/// No joint stands stiller than this, rad/s or rad/s²: it only guards a division.
const TINY: f64 = 1e-9;

impl PathProgress {
    /// Fractions of what the joints can bear with which braking is tried, when a [`Limiter`](crate::Limiter) refuses more: it looks
    /// ahead to the joint's stop, which the trajectory's present state does not tell. Chosen by hand.
    pub const EFFORTS: [f64; 4] = [1.0, 0.6, 0.3, 0.0];
    /// At the start of a trajectory, at its planned speed.
    pub const START: Self = Self { elapsed: 0.0, speed_override: 1.0, override_rate: 0.0 };

    /// Whether the arm goes on at the planned speed.
    pub fn is_at_planned_speed(&self) -> bool {
        self.speed_override == 1.0 && self.override_rate == 0.0
    }

    /// Whether it does not go on at all.
    pub fn stands(&self) -> bool {
        self.speed_override == 0.0 && self.override_rate == 0.0
    }

    /// Progress on the trajectory through these knots after `dt` s in which the override goes to `wanted`, 0 to 1, as fast as the joints' limits allow, times
    /// `effort`.
    pub fn towards(
        &self,
        wanted: f64,
        knots: &[Knot],
        limits: &[JointLimits; 7],
        effort: f64,
        dt: f64,
    ) -> Self {
        let away = self.speed_override - wanted;
        if away == 0.0 && self.override_rate == 0.0 {
            return Self { elapsed: self.elapsed + dt * wanted, ..*self };
        }
        let OverrideLimits { falling, rising, change, usual_change } = self.override_limits(knots, limits);
        let most = effort * if away > 0.0 { falling } else { rising };
        let foreseen = effort * FORESEEN * usual_change;
        let needed = self.override_rate.powi(2) / (2.0 * away.abs().max(TINY));
        let rate = if away * self.override_rate < 0.0 && needed > foreseen {
            // It has come nearer than was foreseen: the change ends harder.
            self.override_rate + away.signum() * dt * needed.min(usual_change)
        } else {
            towards_zero(away, self.override_rate, most, foreseen, dt)
        };
        let rate = rate.clamp(self.override_rate - dt * change.0, self.override_rate + dt * change.1);
        let speed_override = self.speed_override + dt * rate;
        let has_arrived = (speed_override - wanted).abs() < ARRIVED.0 && rate.abs() < ARRIVED.1;
        let has_passed = !(0.0..=1.0).contains(&speed_override);
        let (speed_override, override_rate) = match (has_arrived, has_passed) {
            (true, _) => (wanted, 0.0),
            (_, true) => (speed_override.clamp(0.0, 1.0), 0.0),
            _ => (speed_override, rate),
        };
        Self { elapsed: self.elapsed + dt * speed_override, speed_override, override_rate }
    }

    /// With q the planned movement and s the override, a joint's acceleration is q'' s² + q' s' and its jerk
    /// q''' s³ + 3 q'' s s' + q' s''.
    fn override_limits(&self, knots: &[Knot], limits: &[JointLimits; 7]) -> OverrideLimits {
        let (s, rate) = (self.speed_override, self.override_rate);
        let mut bounds = OverrideLimits {
            falling: MOST_RATE,
            rising: MOST_RATE,
            change: (MOST_CHANGE, MOST_CHANGE),
            usual_change: MOST_CHANGE,
        };
        let (states, jerks) = (state_at(knots, self.elapsed), jerk_at(knots, self.elapsed));
        for ((state, planned_jerk), limit) in states.iter().zip(jerks).zip(limits) {
            let (most, most_jerk) = (USED * limit.acceleration, USED * limit.jerk);
            // What of a limit is left for a change of the override by `slope` per unit, in the direction `sign`.
            let room = |most: f64, used: f64, slope: f64, sign: f64| {
                let opposed = sign * slope.signum() * used;
                (most - opposed).max(0.0) / slope.abs().max(TINY)
            };
            let (velocity, bend) = (state.velocity, state.acceleration * s * s);
            let (twist, turn) = (planned_jerk * s.powi(3), 3.0 * state.acceleration * s);
            bounds.falling =
                bounds.falling.min(room(most, bend, velocity, -1.0)).min(room(most_jerk, twist, turn, -1.0));
            bounds.rising =
                bounds.rising.min(room(most, bend, velocity, 1.0)).min(room(most_jerk, twist, turn, 1.0));
            bounds.usual_change = bounds.usual_change.min(room(most_jerk, 0.0, velocity, 1.0));
            let used = twist + turn * rate;
            bounds.change.0 = bounds.change.0.min(room(most_jerk, used, velocity, -1.0));
            bounds.change.1 = bounds.change.1.min(room(most_jerk, used, velocity, 1.0));
        }
        bounds
    }
}
