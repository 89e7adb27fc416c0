use coact_messages::TrackedPoint;
use coact_period::cycles;
use coact_safety::PersonLimits;

/// How far something may be from where it is expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Growth {
    /// Time since it was seen, s.
    pub age: f64,
    /// What it may accelerate with, m/s².
    pub acceleration: f64,
    /// By how much its velocity is older than its position, s.
    pub velocity_lag: f64,
    /// Its greatest possible speed, m/s.
    pub most_speed: f64,
}

impl Growth {
    /// So far `ahead` s from now, m: by what it has accelerated since it was seen, and what it had not yet been seen to be faster
    /// by then, at its greatest speed at most.
    pub fn after(&self, ahead: f64) -> f64 {
        let time = self.age + ahead;
        (self.acceleration * time * (0.5 * time + self.velocity_lag)).min(self.most_speed * time)
    }
}

/// Whether a joint has been where it is for long enough to be sure that it rests.
pub(super) fn rests(joint: &TrackedPoint, limits: &PersonLimits) -> bool {
    joint.still >= cycles(limits.rests_after)
}
