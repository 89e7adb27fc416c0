use coact_recordings::{ArmSide, BodyFrame, BodyRecording};
use glam::DVec3;

/// Frames to either side over which the hand is averaged: 90 ms in all.
const HAND: usize = 4;
/// The same of hip and shoulders, which turn slowly.
const BODY: usize = 10;

/// Acceleration that no body had, m/s²: a place that exceeds it jumps, for its markers were mistaken for others. (Recorded hands have
/// 25 m/s² at most in 99.9 % of all frames.)
const FASTEST: f64 = 100.0;

/// Where a hand was against the body, frame by frame: a left hand as if it were a right one.
pub(crate) struct HandCourse {
    /// s.
    pub times: Vec<f64>,
    /// To the right, ahead and up from the middle of the hip, m; none where a body was lost.
    pub places: Vec<Option<DVec3>>,
}

impl HandCourse {
    pub fn of(recording: &BodyRecording, side: ArmSide) -> Self {
        let frames = &recording.frames;
        let hand = smoothed(frames, HAND, |frame| frame.hands[side as usize]);
        let hip = smoothed(frames, BODY, |frame| frame.hip);
        let [left, right] = [0, 1].map(|own| smoothed(frames, BODY, move |frame| frame.shoulders[own]));
        let mirror = if side == ArmSide::Left { -1.0 } else { 1.0 };
        let place = |index: usize| {
            let aside = (right[index]? - left[index]?).with_z(0.0).try_normalize()?;
            let reached = hand[index]? - hip[index]?;
            Some(DVec3::new(mirror * reached.dot(aside), reached.dot(DVec3::Z.cross(aside)), reached.z))
        };
        Self {
            times: frames.iter().map(|frame| frame.time).collect(),
            places: (0..frames.len()).map(place).collect(),
        }
    }

    /// How fast the hand was in each frame, m/s; none where it is not seen in the frames beside.
    pub fn speeds(&self) -> Vec<Option<f64>> {
        let speed = |index: usize| {
            let (before, after) = (index.checked_sub(1)?, index + 1);
            let moved = self.places.get(after).copied()?? - self.places[before]?;
            Some(moved.length() / (self.times[after] - self.times[before]))
        };
        (0..self.places.len()).map(speed).collect()
    }
}

/// Means over the frames beside; what was lost in a frame, or jumped, stays lost.
fn smoothed(
    frames: &[BodyFrame],
    beside: usize,
    place: impl Fn(&BodyFrame) -> Option<[f64; 3]>,
) -> Vec<Option<DVec3>> {
    let places: Vec<_> = frames.iter().map(|frame| place(frame).map(DVec3::from)).collect();
    let jumps = |index: usize| {
        let (before, after) = (index.checked_sub(1)?, index + 1);
        let (step, next) = (places[index]? - places[before]?, places.get(after).copied()?? - places[index]?);
        let time = 0.5 * (frames[after].time - frames[before].time);
        Some((next - step).length() / (time * time) > FASTEST)
    };
    let places: Vec<_> =
        (0..places.len()).map(|index| places[index].filter(|_| jumps(index) != Some(true))).collect();
    let mean = |index: usize| {
        places[index]?;
        let around = &places[index.saturating_sub(beside)..(index + beside + 1).min(places.len())];
        let seen = around.iter().flatten();
        let count = seen.clone().count() as f64;
        Some(seen.sum::<DVec3>() / count)
    };
    (0..places.len()).map(mean).collect()
}
