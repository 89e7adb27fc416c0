use super::arm_bound::ArmBound;
use super::growth::{Growth, rests};
use coact_messages::TrackedPoint;
use coact_motion::Capsule;
use coact_period::{cycles, seconds};
use coact_safety::{PersonLimits, StaleLimits};
use nalgebra::{Point3, Vector3};

/// A part of the person's body, or what the hand holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BodyPart {
    pub(super) now: Capsule,
    /// Velocities of its ends, m/s.
    velocities: [Vector3<f64>; 2],
    /// For how long it is taken to go on as it moves, s.
    extrapolated: f64,
    /// Whether it was seen recently.
    pub is_seen: bool,
    /// Whether it moves, faster than what only seems to.
    pub moves: bool,
    /// Whether it is so fast that it is soon on the other side of what it passes.
    pub is_fast: bool,
    /// Its speed, m/s, as far as it is known.
    pub(super) speed: f64,
    pub(super) growth: Growth,
    /// Where the arm's length binds it to, while some joint that it hangs on is seen and it is not.
    pub(super) bound: Option<ArmBound>,
    /// Whether it may take or give a part in a handover.
    pub hands_over: bool,
}

impl BodyPart {
    /// The line between two joints.
    pub(crate) fn between(
        from: &TrackedPoint,
        to: &TrackedPoint,
        limits: &PersonLimits,
        stale: &StaleLimits,
    ) -> Self {
        let age = from.age.max(to.age);
        let is_seen = age <= cycles(stale.hand_after);
        let velocities =
            [from, to].map(|point| if is_seen { Vector3::from(point.velocity) } else { Vector3::zeros() });
        let known = velocities.iter().map(Vector3::norm).fold(0.0, f64::max);
        let speed = if is_seen { known } else { limits.hand_speed };
        let rests = is_seen && rests(from, limits) && rests(to, limits);
        Self {
            now: Capsule { start: Point3::from(from.position), end: Point3::from(to.position), radius: 0.0 },
            velocities,
            extrapolated: limits.extrapolated.as_secs_f64(),
            is_seen,
            moves: is_seen && !rests && speed >= limits.speeds[0],
            is_fast: is_seen && !rests && speed >= limits.speeds[1],
            speed,
            growth: Growth {
                age: seconds(age),
                acceleration: limits.acceleration(rests, speed),
                velocity_lag: limits.velocity_lag.as_secs_f64(),
                most_speed: limits.hand_speed.max(speed),
            },
            bound: None,
            hands_over: false,
        }
    }

    /// Something not farther than `within` m from it that moves along with where it begins, and was there `ago` s before now.
    pub(super) fn carrying(&self, there: Capsule, ago: f64, within: f64) -> Self {
        let [begin, _] = self.velocities;
        let bound = self.bound.map(|bound| bound.and(&there, within));
        let then = Self { now: there, velocities: [begin; 2], bound, ..*self };
        Self { now: then.after(ago), ..then }
    }

    /// Where it is `ahead` s from now, if it goes on as it moves.
    pub fn after(&self, ahead: f64) -> Capsule {
        let time = ahead.min(self.extrapolated);
        let [start, end] = self.velocities;
        Capsule { start: self.now.start + start * time, end: self.now.end + end * time, ..self.now }
    }

    /// How far it may be from where it is now in so many seconds, m.
    pub fn reach(&self, ahead: f64) -> f64 {
        self.growth(ahead) + self.speed * ahead
    }

    /// How far it may be from there, m.
    pub fn growth(&self, ahead: f64) -> f64 {
        self.growth.after(ahead)
    }

    /// Whether it cannot come nearer than `within` m to this capsule at all, because the arm is no longer.
    pub fn is_bound_away_from(&self, capsule: &Capsule, within: f64, ahead: f64) -> bool {
        self.bound.is_some_and(|bound| bound.distance(capsule, ahead) > within)
    }
}
