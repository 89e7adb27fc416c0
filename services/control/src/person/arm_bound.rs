use super::growth::{Growth, rests};
use coact_messages::TrackedPoint;
use coact_motion::Capsule;
use coact_period::seconds;
use coact_safety::PersonLimits;
use nalgebra::{Point3, Vector3};

/// Where forearm and hand are bound to be: not farther from the shoulder than the arm is long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ArmBound {
    shoulder: Capsule,
    /// The shoulder's own, m/s.
    speed: f64,
    growth: Growth,
}

impl ArmBound {
    pub fn of(shoulder: &TrackedPoint, limb: &Capsule, limits: &PersonLimits) -> Self {
        let (at, speed) = (Point3::from(shoulder.position), Vector3::from(shoulder.velocity).norm());
        let reached = (limb.start - at).norm().max((limb.end - at).norm());
        Self {
            shoulder: Capsule { start: at, end: at, radius: limits.reach.max(reached) + limb.radius },
            speed,
            growth: Growth {
                age: seconds(shoulder.age),
                acceleration: limits.acceleration(rests(shoulder, limits), speed),
                velocity_lag: limits.velocity_lag.as_secs_f64(),
                most_speed: limits.walking_speed.max(speed),
            },
        }
    }

    /// Least distance of the arm from a capsule `ahead` s from now, m, wherever the shoulder goes.
    pub fn distance(&self, capsule: &Capsule, ahead: f64) -> f64 {
        self.shoulder.distance(capsule) - self.growth.after(ahead) - self.speed * ahead
    }
}
