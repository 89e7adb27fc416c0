use crate::HandPose;
use crate::reach_profile::minimum_jerk;
use bytemuck::{Pod, Zeroable};
use coact_period::PERIOD_S;
use coact_stage_state::{Implausible, ensure, finite};

/// Fraction of a grasping movement in which the hand's pitch reaches that of the grip: about when the aperture is largest.
const PITCH_TIME: f64 = 0.7;
/// How much the fingers stretch while they open, m. Chosen by hand.
const STRETCH: f64 = 0.015;

/// One movement of the person's hand. Times in cycles of the run.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct HandMovement {
    /// The hand at its beginning.
    pub from: HandPose,
    /// The hand at its end.
    pub to: HandPose,
    /// When it begins.
    pub start: u64,
    /// Where an observer sees it begin: movement time counts from here.
    pub onset: u64,
    /// When it ends.
    pub end: u64,
    /// How far the path arches above the straight line, m.
    pub arch: f64,
    /// Largest aperture, m; 0 for a movement that does not grasp.
    pub peak_aperture: f64,
    /// Fraction of the movement at which it is reached.
    pub peak_time: f64,
}

impl HandMovement {
    /// Fraction of the movement that has passed at `now`, cycles, in [0, 1].
    pub(crate) fn time(&self, now: f64) -> f64 {
        let span = self.end.saturating_sub(self.start).max(1);
        ((now - self.start as f64).max(0.0) / span as f64).min(1.0)
    }

    /// Time from its onset to `now`, cycles, in s; negative before.
    pub(crate) fn since_onset(&self, now: f64) -> f64 {
        (now - self.onset as f64) * PERIOD_S
    }

    /// The movement is made later by so many cycles.
    pub(crate) fn put_off(&mut self, delay: u64) {
        self.start += delay;
        self.onset += delay;
        self.end += delay;
    }

    pub(crate) fn is_over(&self, tick: u64) -> bool {
        tick >= self.end
    }

    /// Refuses times that do not stand in their order, or are near overflow, and numbers that are none.
    pub(crate) fn check(&self) -> Result<(), Implausible> {
        let ordered = self.start <= self.onset && self.onset <= self.end;
        let far = u64::from(u32::MAX) << 16;
        ensure(ordered && self.end <= far, "person.movement", "start, onset and end in this order")?;
        let peaks_within = self.peak_aperture == 0.0 || (self.peak_time > 0.0 && self.peak_time < 1.0);
        ensure(peaks_within, "person.movement.peak_time", "a fraction of the movement")?;
        finite("person.movement", bytemuck::cast_slice(&[self.from, self.to]))?;
        finite("person.movement", &[self.arch, self.peak_aperture, self.peak_time])
    }

    /// The hand at `tick`.
    pub(crate) fn pose(&self, tick: u64) -> HandPose {
        self.pose_at(tick as f64)
    }

    /// The hand at `now`, cycles.
    pub(crate) fn pose_at(&self, now: f64) -> HandPose {
        let time = self.time(now);
        let along = minimum_jerk(time);
        let mut pose = self.from.towards(&self.to, along);
        pose.wrist[2] += self.arch * 16.0 * along * along * (1.0 - along) * (1.0 - along);
        if self.peak_aperture > 0.0 {
            self.shape(time, &mut pose);
        }
        pose
    }

    /// The preshaping of a grasping hand: it turns, opens beyond the part's width and closes on the part.
    fn shape(&self, time: f64, pose: &mut HandPose) {
        let turned = minimum_jerk(time / PITCH_TIME);
        pose.pitch = self.from.pitch + (self.to.pitch - self.from.pitch) * turned;
        let opened = minimum_jerk(time / self.peak_time);
        let closed = minimum_jerk((time - self.peak_time) / (1.0 - self.peak_time));
        pose.aperture = self.from.aperture
            + (self.peak_aperture - self.from.aperture) * opened
            + (self.to.aperture - self.peak_aperture) * closed;
        pose.extension = self.from.extension + (self.to.extension - self.from.extension + STRETCH) * opened
            - STRETCH * closed;
    }
}
