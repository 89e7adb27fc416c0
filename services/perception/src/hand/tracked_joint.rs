use crate::plausible_cycle::cycle;
use bytemuck::{Pod, Zeroable};
use coact_period::{cycles, seconds};
use coact_stage_state::{Implausible, finite};
use nalgebra::Vector3;
use std::time::Duration;

/// A joint of the arm by itself: where it is and how it moves, filtered over the frames that have shown it.
///
/// The filter is an alpha-beta filter whose gains follow how far the joint is from where it was foretold: those of a joint that does
/// what was foretold take out the tracker's scatter, those of one that accelerates follow it.
///
/// A joint that followed another one would lag behind where the arm turns: the tip of a hand that swings is twice as fast as
/// its wrist, and was thought to be 40 mm from where it was.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct TrackedJoint {
    /// At the newest frame that has shown it, m.
    position: [f64; 3],
    /// m/s.
    velocity: [f64; 3],
    /// How far it was lately from where it was foretold, smoothed, m.
    surprise: [f64; 3],
    /// Cycle of that frame, plus one; 0: none has.
    found: u64,
    /// Where it was when it moved last, m, and the cycle of that frame, plus one: since then it is within [`STILL_WITHIN`].
    rested_at: [f64; 3],
    moved: u64,
}

/// How far ahead of the newest frame a joint is extrapolated: three frames at 60 Hz. Chosen by hand: farther ahead, a
/// reaching hand has changed its velocity too much.
pub(super) const EXTRAPOLATED: u64 = cycles(Duration::from_millis(50));
/// Jump from frame to frame, m, that shows another hand, or the same one after a long gap: at 60 Hz, a hand would have to move
/// at 15 m/s.
const JUMP: f64 = 0.25;
/// Longest gap between two frames that is bridged: after it, the filter starts anew. Chosen by hand: half a reach.
pub(super) const LONGEST_GAP: u64 = cycles(Duration::from_millis(350));
/// Shortest time between frames that velocities are computed with, s: two frames with nearly the same stamp would make an
/// absurd one. A tracker of 200 frames a second still keeps it.
pub(super) const SHORTEST_GAP: f64 = 0.005;

/// A joint that stays this near to a place is still, m: several times a tracker's scatter. Whoever is 0.05 m/s fast leaves it within
/// 0.2 s.
const STILL_WITHIN: f64 = 0.01;
/// Gains for position and velocity while nothing surprises, and while all does. These and the next three are fitted to half of the
/// motion capture (stacking, handovers to the robot), seen by a simulated tracker of 60 Hz and 2 mm. In the other half joints that rest
/// then seem to move by 0.02 m/s, with the fixed gains 0.7 and 0.35 by 0.08; 99 % of the finger tips that are slower than 0.05, 0.3 and
/// 1 m/s, and of faster ones, are within 11, 42, 114 and 526 mm of where they are foretold 0.12 s after the frame, with those fixed
/// gains 26, 40, 110 and 563.
const CALM: (f64, f64) = (0.4, 0.08);
/// See [`CALM`].
const LIVELY: (f64, f64) = (0.9, 0.6);
/// The surprise up to which all is calm, and from which it is lively, m.
const SURPRISES: (f64, f64) = (0.004, 0.010);
/// Weight of the former surprise in the smoothed one.
const REMEMBERED: f64 = 0.6;
/// How a joint goes on in the mean over the next tenth of a second, beside its velocity. Fitted on the same half of the motion capture
/// (least cubes of what it then is off, so that large misses count): by so much for each metre of surprise, 1/s, at this speed, m/s, and
/// above; at lower ones in proportion, for there the surprise is scatter. In the other half, after 0.1 s, 99 % of the joints of 0.2 to
/// 1 m/s, and of faster ones, are within 80 and 203 mm of where they are expected, by their velocity alone within 106 and 275.
const PURSUED: (f64, f64) = (46.0, 0.3);
/// What a movement loses of its velocity meanwhile: this fraction, and for each m/s above the speed that stands second by the third,
/// up to 1 m/s more. Fast hands brake soon.
const LOST: (f64, f64, f64) = (0.15, 1.0, 0.25);

impl TrackedJoint {
    /// Standing at `place`, seen at cycle `captured`.
    pub fn standing_at(place: Vector3<f64>, captured: u64) -> Self {
        let found = captured.saturating_add(1);
        let position = place.into();
        Self { position, velocity: [0.0; 3], surprise: [0.0; 3], found, rested_at: position, moved: found }
    }

    /// A frame of cycle `captured` has shown it at `place`; a frame that is not newer than the last one is left out.
    pub fn observe(&mut self, place: Vector3<f64>, captured: u64) {
        let gap = (captured.saturating_add(1)).saturating_sub(self.found);
        if gap == 0 {
            return;
        }
        let time = seconds(gap);
        let predicted = self.position() + self.velocity() * time;
        if self.found == 0 || gap > LONGEST_GAP || (place - self.position()).norm() > JUMP {
            *self = Self::standing_at(place, captured);
            return;
        }
        let miss = place - predicted;
        let (position, velocity) = self.gains(miss);
        self.position = (predicted + position * miss).into();
        self.velocity = (self.velocity() + miss * (velocity / time.max(SHORTEST_GAP))).into();
        self.found = captured.saturating_add(1);
        if (self.position() - Vector3::from(self.rested_at)).norm() > STILL_WITHIN {
            (self.rested_at, self.moved) = (self.position, self.found);
        }
    }

    /// The gains for a joint that is so far from where it was foretold, m.
    fn gains(&mut self, miss: Vector3<f64>) -> (f64, f64) {
        let surprise = REMEMBERED * Vector3::from(self.surprise) + (1.0 - REMEMBERED) * miss;
        self.surprise = surprise.into();
        let (calm, lively) = SURPRISES;
        let liveliness = ((surprise.norm() - calm) / (lively - calm)).clamp(0.0, 1.0);
        let between = |calm: f64, lively: f64| calm + liveliness * (lively - calm);
        (between(CALM.0, LIVELY.0), between(CALM.1, LIVELY.1))
    }

    /// Extrapolated to `tick`, m.
    pub fn at(&self, tick: u64) -> Vector3<f64> {
        let age = tick.saturating_add(1).saturating_sub(self.found);
        self.position() + self.velocity() * seconds(age.min(EXTRAPOLATED))
    }

    /// Where it is expected at `tick`, m, if it goes on with its [expected velocity](Self::expected_velocity).
    pub fn expected_at(&self, tick: u64) -> Vector3<f64> {
        let age = tick.saturating_add(1).saturating_sub(self.found);
        self.position() + self.expected_velocity() * seconds(age.min(EXTRAPOLATED))
    }

    /// How it is expected to move in the mean over the next tenth of a second, m/s: a joint that surprises accelerates, which its velocity
    /// follows late.
    pub fn expected_velocity(&self) -> Vector3<f64> {
        let (velocity, speed) = (self.velocity(), self.velocity().norm());
        let (most, from) = PURSUED;
        let pursued = most * (speed / from).min(1.0);
        let (always, above, more) = LOST;
        let lost = always + more * (speed - above).clamp(0.0, 1.0);
        velocity * (1.0 - lost) + Vector3::from(self.surprise) * pursued
    }

    /// For how long it has been where it is, cycles.
    pub fn still_for(&self, tick: u64) -> u64 {
        tick.saturating_add(1).saturating_sub(self.moved)
    }

    /// At the newest frame, m.
    pub fn position(&self) -> Vector3<f64> {
        self.position.into()
    }

    /// m/s.
    pub fn velocity(&self) -> Vector3<f64> {
        self.velocity.into()
    }

    /// Whether this place is so far from it that it shows another hand.
    pub fn has_jumped_to(&self, place: Vector3<f64>) -> bool {
        (place - self.position()).norm() > JUMP
    }

    /// Refuses what is no state of a joint.
    pub fn check(&self) -> Result<(), Implausible> {
        cycle("hand.joint.found", self.found)?;
        cycle("hand.joint.moved", self.moved)?;
        finite("hand.joint", &[self.position, self.velocity, self.surprise, self.rested_at].concat())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: u64 = 17;

    /// A joint that has been seen in 30 frames on a way, m by cycle.
    fn followed(way: impl Fn(f64) -> Vector3<f64>) -> TrackedJoint {
        let mut joint = TrackedJoint::zeroed();
        (0..30).for_each(|frame| joint.observe(way(seconds(frame * FRAME)), frame * FRAME));
        joint
    }

    #[test]
    fn a_joint_that_moves_steadily_is_where_it_is_now() {
        let way = |time: f64| Vector3::new(1.2 * time, 0.3, 1.0 - 0.4 * time);
        let joint = followed(way);
        let now = 29 * FRAME + 33;
        assert!((joint.at(now) - way(seconds(now))).norm() < 1e-3, "{:?}", joint.at(now));
        assert!((joint.velocity() - Vector3::new(1.2, 0.0, -0.4)).norm() < 1e-2);
    }

    #[test]
    fn a_joint_that_swings_is_nearer_than_one_that_follows_another() {
        // The tip of a hand that turns about a wrist that rests: 0.18 m long, 6 rad/s.
        let tip = |time: f64| 0.18 * Vector3::new((6.0 * time).cos(), (6.0 * time).sin(), 0.0);
        let now = 29 * FRAME + 30;
        let off = (followed(tip).at(now) - tip(seconds(now))).norm();
        let followed_wrist = (tip(seconds(29 * FRAME)) - tip(seconds(now))).norm();
        assert!(off < 0.012 && followed_wrist > 0.03, "{off} m, {followed_wrist} m");
    }

    #[test]
    fn a_joint_that_rests_does_not_seem_to_move_and_one_that_sets_out_is_followed() {
        // Scatter of 2 mm along each axis, without a random number: incommensurate oscillations.
        let scatter =
            |time: f64| Vector3::new(421.0, 633.0, 977.0).map(|rate: f64| 0.0028 * (rate * time).sin());
        let rests = followed(scatter);
        assert!(rests.velocity().norm() < 0.06, "{} m/s", rests.velocity().norm());
        // 6 m/s² for the last 0.15 s.
        let sets_out =
            |time: f64| Vector3::new(3.0 * (time - 28.0 * 0.017 + 0.15).max(0.0).powi(2), 0.0, 0.0);
        let (joint, now) = (followed(|time| sets_out(time) + scatter(time)), 29 * FRAME + 20);
        let off = (joint.at(now) - sets_out(seconds(now))).norm();
        assert!(off < 0.03, "{off} m");
    }

    #[test]
    fn a_joint_that_gains_speed_is_expected_nearer_to_where_it_will_be_than_its_velocity_tells() {
        // A reach of 0.35 m in 0.7 s, seen up to a fifth and a third of it: as people reach, with least jerk.
        let reach = |begun: f64| {
            move |time: f64| {
                let part = ((time - begun) / 0.7).clamp(0.0, 1.0);
                let way = 0.35 * part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part);
                Vector3::new(way, 0.0, 0.0)
            }
        };
        let newest = seconds(29 * FRAME);
        for begun in [newest - 0.14, newest - 0.23] {
            let (way, joint) = (reach(begun), followed(reach(begun)));
            let off = |velocity: Vector3<f64>| (joint.position() + velocity * 0.1 - way(newest + 0.1)).norm();
            let (expected, told) = (off(joint.expected_velocity()), off(joint.velocity()));
            assert!(expected < 0.7 * told, "{expected} m, by its velocity {told} m");
        }
        let rests = followed(|_| Vector3::new(0.3, 0.2, 0.0));
        assert!(rests.expected_velocity().norm() < 1e-9);
    }

    #[test]
    fn a_joint_is_still_from_when_it_has_stopped_and_not_when_it_was_just_found() {
        let stops = |time: f64| Vector3::new(time.min(0.2), 0.0, 0.0);
        let now = 29 * FRAME;
        let still_for = followed(stops).still_for(now);
        assert!((200..=300).contains(&still_for), "{still_for}");
        assert!(followed(|time| Vector3::new(time, 0.0, 0.0)).still_for(now) <= 1);
        let found = TrackedJoint::standing_at(Vector3::zeros(), now);
        assert_eq!((found.still_for(now), found.still_for(now + 40)), (0, 40));
    }

    #[test]
    fn extrapolation_ends_and_a_jump_or_a_long_gap_starts_anew() {
        let joint = followed(|time| Vector3::new(time, 0.0, 0.0));
        assert_eq!(joint.at(5_000), joint.at(29 * FRAME + EXTRAPOLATED));
        for (place, cycle) in [(Vector3::new(0.5, 0.4, 0.0), 30 * FRAME), (Vector3::new(0.5, 0.0, 0.0), 900)]
        {
            let mut other = joint;
            other.observe(place, cycle);
            assert_eq!((other.position(), other.velocity()), (place, Vector3::zeros()));
        }
    }

    #[test]
    fn a_frame_counts_once() {
        let joint = followed(|time| Vector3::new(time, 0.0, 0.0));
        let mut again = joint;
        again.observe(Vector3::new(0.6, 0.0, 0.0), 29 * FRAME);
        again.observe(Vector3::new(0.6, 0.0, 0.0), 3 * FRAME);
        assert_eq!(bytemuck::bytes_of(&joint), bytemuck::bytes_of(&again));
    }
}
