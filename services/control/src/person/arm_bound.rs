use super::growth::{Growth, rests};
use coact_messages::TrackedPoint;
use coact_motion::Capsule;
use coact_period::seconds;
use coact_safety::PersonLimits;
use nalgebra::{Point3, Vector3};

/// Where a part of the arm is bound to be that is not seen: not farther from a joint that is than the arm goes on from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ArmBound {
    around: Capsule,
    /// The joint's own, m/s.
    speed: f64,
    growth: Growth,
}

impl ArmBound {
    /// Of a `limb` in an arm that is so many m `long` from this joint, which itself moves at this speed at most, m/s.
    pub fn of(
        joint: &TrackedPoint,
        (long, most_speed): (f64, f64),
        limb: &Capsule,
        limits: &PersonLimits,
    ) -> Self {
        let (at, speed) = (Point3::from(joint.position), Vector3::from(joint.velocity).norm());
        let reached = (limb.start - at).norm().max((limb.end - at).norm());
        Self {
            around: Capsule { start: at, end: at, radius: long.max(reached) + limb.radius },
            speed,
            growth: Growth {
                age: seconds(joint.age),
                acceleration: limits.acceleration(rests(joint, limits), speed),
                velocity_lag: limits.velocity_lag.as_secs_f64(),
                most_speed: most_speed.max(speed),
            },
        }
    }

    /// The same of a part that is not farther than `within` m from the limb.
    pub fn and(mut self, part: &Capsule, within: f64) -> Self {
        self.around.radius += within + (part.end - part.start).norm() + 2.0 * part.radius;
        self
    }

    /// Least distance of the arm from a capsule `ahead` s from now, m, wherever the joint goes.
    pub fn distance(&self, capsule: &Capsule, ahead: f64) -> f64 {
        self.around.distance(capsule) - self.growth.after(ahead) - self.speed * ahead
    }
}
