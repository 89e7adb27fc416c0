use super::TrackedHand;
use super::tracked_joint::TrackedJoint;
use coact_messages::{KeypointName, PersonArm, TrackedPoint};
use coact_period::seconds;

/// Scatter of a keypoint, m. Recorded ones lie 0.7 pixels (median; 6 mm) off the line between their neighbours in time,
/// simulated ones scatter by 2 mm along each axis.
const SCATTER: f64 = 0.005;
/// Standard deviation of an acceleration that nothing foretold, m/s². A prediction with constant velocity over 0.1 to
/// 0.2 s keeps 99.9 % of the hands that moved at 0.2 to 1 m/s within what 15 m/s² make of it (motion capture of stacking
/// and handovers, 40 000 samples): about three standard deviations.
const ACCELERATION: f64 = 5.0;
/// Speed of a hand that ISO 13855 reckons with, m/s.
const HAND_SPEED: f64 = 2.0;

impl TrackedHand {
    /// The person's arm at `tick`: each joint filtered and extrapolated by itself. One that was never found is where the
    /// next one is.
    pub fn arm_at(&self, tick: u64) -> PersonArm {
        let [shoulder, elbow, wrist, fingertip] = self.joints();
        let elbow = if self.is_known(KeypointName::Elbow) { elbow } else { wrist };
        let shoulder = if self.is_known(KeypointName::Shoulder) { shoulder } else { elbow };
        let point = |name, joint: &TrackedJoint| TrackedPoint {
            position: joint.expected_at(tick).into(),
            velocity: joint.expected_velocity().into(),
            deviation: self.deviation(name, joint.velocity().norm(), tick),
            age: self.age_of(name, tick).unwrap_or(u64::MAX),
            still: joint.still_for(tick),
        };
        PersonArm {
            shoulder: point(KeypointName::Shoulder, shoulder),
            elbow: point(KeypointName::Elbow, elbow),
            wrist: point(KeypointName::Wrist, wrist),
            fingertip: point(KeypointName::MiddleTip, fingertip),
            age: self.age(tick),
            tracked: u32::from(self.is_tracked(tick)),
            reserved: 0,
        }
    }

    /// Standard deviation of a joint that moves at `speed`, m: its scatter, and how far it may be from where it is thought
    /// to be, given the time since it was found. In that time it may have accelerated; from where extrapolation ends, it
    /// goes on unnoticed; but it is not faster than hands are.
    fn deviation(&self, name: KeypointName, speed: f64, tick: u64) -> f64 {
        let Some(age) = self.age_of(name, tick) else { return f64::INFINITY };
        let (time, unnoticed) =
            (seconds(age), seconds(age.saturating_sub(super::tracked_joint::EXTRAPOLATED)));
        let accelerated = 0.5 * ACCELERATION * time * time + speed * unnoticed;
        SCATTER.hypot(accelerated.min(HAND_SPEED.max(speed) * time))
    }
}
