use super::hand_movement::extent;
use super::keypoints::{ALL, BELIEVED, Keypoints, shown};
use super::tracked_joint::{LONGEST_GAP, SHORTEST_GAP, TrackedJoint};
use super::{HandMovement, ViewFrame};
use crate::plausible_cycle::cycle;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{HandView, KeypointName};
use coact_period::{cycles, seconds};
use coact_stage_state::{Implausible, ensure, finite};
use nalgebra::Vector3;
use std::time::Duration;

/// Frames kept: speed is taken over all of them, which halves the tracker's noise at the price of 40 ms.
const FRAMES: usize = 6;
/// Frames that are averaged for what the hand's shape is read from: less of the tracker's scatter, at the price of one
/// frame's delay.
const AVERAGED: usize = 3;
/// Age up to which the newest frame tells where the hand is now: nine frames at 60 Hz, so that dropped ones are bridged.
pub(crate) const USABLE: u64 = cycles(Duration::from_millis(150));
/// The joints of the arm that are followed each by itself.
const JOINTS: [KeypointName; 4] =
    [KeypointName::Shoulder, KeypointName::Elbow, KeypointName::Wrist, KeypointName::MiddleTip];
/// Place of the wrist among them.
const WRIST: usize = 2;
/// Shortest time that velocities are computed with a velocity over [`AVERAGED`] frames, s.
const SHORTEST_SPAN: f64 = 0.01;
/// Weight of a new frame in the rate at which the pitch changes. Chosen by hand.
const PITCH_GAIN: f64 = 0.4;
/// How far ahead the pitch is looked, s: about what camera and filter delay it by. Chosen by hand.
const PITCH_AHEAD: f64 = 0.08;
/// Largest change of pitch that is foretold, rad. Chosen by hand.
const MOST_PITCH_AHEAD: f64 = 0.5;
/// By how much the index finger is longer than the middle one when it is stretched out alone, m: several times the tracker's scatter.
/// Chosen by hand.
const ALONE: f64 = 0.02;

/// What must be found of a hand of which a part may be hidden.
const WHOLE_HAND: [KeypointName; 5] = [
    KeypointName::Wrist,
    KeypointName::ThumbTip,
    KeypointName::IndexTip,
    KeypointName::IndexKnuckle,
    KeypointName::LittleKnuckle,
];

/// What a hand that is hidden leaves in sight, and binds it: how far the hand may be away is known from the shoulder, and from the wrist
/// where that is seen.
const ARM: [KeypointName; 3] = [KeypointName::Shoulder, KeypointName::Elbow, KeypointName::Wrist];

/// The tracked hand.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct TrackedHand {
    /// Newest frame's number plus one; 0 before the first.
    seen: u64,
    /// Cycle at which it was captured.
    pub captured: u64,
    /// Where each keypoint of its arm was found.
    keypoints: Keypoints,
    /// Shoulder, elbow, wrist and fingertip.
    joints: [TrackedJoint; JOINTS.len()],
    /// How fast the hand's pitch changes, rad/s, filtered.
    pitch_rate: f64,
    /// Pitch at the newest frame, rad.
    pitch: f64,
    /// Valid entries of `recent`.
    frames: u64,
    /// The newest frames, newest last.
    recent: [ViewFrame; FRAMES],
    /// Bit i set: the frame that came i before the newest one shows thumb and index tip itself.
    centred: u64,
    /// The present movement.
    pub movement: HandMovement,
}

impl TrackedHand {
    /// Takes in the tracker's newest frame. `None` if it is not a new and usable one; true if a movement has begun.
    ///
    /// While something may hide the hand, as `hide` says, a frame without wrist, knuckles or finger tips is none: a hand that is half out
    /// of sight tells neither its grip nor its pitch. Nor is a frame one that shows nothing of the hand: where shoulder and elbow are it tells.
    pub fn observe(&mut self, tick: u64, view: &HandView, hide: impl FnOnce(&Self) -> bool) -> Option<bool> {
        let found = |name: &KeypointName| view.keypoints[*name as usize].confidence > BELIEVED;
        let known = self.seen == view.frame.wrapping_add(1);
        let late = self.seen > 0 && view.captured_cycle <= self.captured;
        if known || late || view.captured_cycle > tick {
            return None;
        }
        let nothing_of_it = !WHOLE_HAND.iter().any(found);
        if nothing_of_it || (!WHOLE_HAND.iter().all(found) && hide(self)) {
            self.merge(view, &ARM);
            return None;
        }
        let (before, lay) = (self.joints[WRIST], self.point(KeypointName::Wrist));
        if !self.merge(view, &ALL) {
            return None;
        }
        self.keypoints.take_along(self.point(KeypointName::Wrist) - lay, view.captured_cycle);
        let gap = view.captured_cycle.saturating_sub(self.captured);
        let time = seconds(gap).max(SHORTEST_GAP);
        let pitch = self.raw_pitch();
        self.pitch_rate += PITCH_GAIN * ((pitch - self.pitch) / time - self.pitch_rate);
        self.pitch = pitch;
        self.seen = view.frame.wrapping_add(1);
        self.captured = view.captured_cycle;
        let found = self.point(KeypointName::Wrist);
        if self.frames == 0 || gap > LONGEST_GAP || before.has_jumped_to(found) {
            self.start_over(found);
        }
        self.remember();
        Some(self.movement.advance(self.newest_place(), self.steady_speed(), self.captured))
    }

    /// Where wrist and centre are, averaged over two frames, m; no centre where one of them does not show it.
    fn newest_place(&self) -> (Vector3<f64>, Option<Vector3<f64>>) {
        let newest = self.averaged(2);
        let shown = self.shows_centre(0) && self.shows_centre(1);
        (newest.wrist.into(), shown.then(|| newest.centre()))
    }

    /// Takes in these keypoints of a frame. False before wrist and finger tips are all known, or when the frame holds none of them.
    fn merge(&mut self, view: &HandView, names: &[KeypointName]) -> bool {
        for (joint, name) in self.joints.iter_mut().zip(JOINTS).filter(|(_, name)| names.contains(name)) {
            if let Some(place) = shown(view, name) {
                let place = if name == KeypointName::MiddleTip { fingertip(view, place) } else { place };
                joint.observe(place.into(), view.captured_cycle);
            }
        }
        let needed =
            [KeypointName::Wrist, KeypointName::ThumbTip, KeypointName::IndexTip, KeypointName::MiddleTip];
        self.keypoints.take_in(view, names) && needed.iter().all(|name| self.is_known(*name))
    }

    fn start_over(&mut self, found: Vector3<f64>) {
        self.joints[WRIST] = TrackedJoint::standing_at(found, self.captured);
        self.pitch_rate = 0.0;
        (self.frames, self.centred) = (0, 0);
        self.movement = HandMovement::still_at(found);
    }

    fn remember(&mut self) {
        if self.frames as usize == FRAMES {
            self.recent.rotate_left(1);
        } else {
            self.frames += 1;
        }
        self.recent[self.frames as usize - 1] = ViewFrame {
            cycle: self.captured,
            wrist: self.point(KeypointName::Wrist).into(),
            thumb: self.point(KeypointName::ThumbTip).into(),
            index: self.point(KeypointName::IndexTip).into(),
            middle: self.point(KeypointName::MiddleTip).into(),
        };
        let centre = [KeypointName::ThumbTip, KeypointName::IndexTip];
        self.centred = self.centred << 1
            | u64::from(centre.iter().all(|name| self.age_of(*name, self.captured) == Some(0)));
    }

    /// Mean of the newest frames' points; `cycle` is the newest one's. Zeros before the first frame.
    pub fn averaged(&self, frames: usize) -> ViewFrame {
        let newest = self.recent();
        let newest = &newest[newest.len().saturating_sub(frames)..];
        let mean = |of: fn(&ViewFrame) -> [f64; 3]| -> [f64; 3] {
            let sum: Vector3<f64> = newest.iter().map(|frame| Vector3::from(of(frame))).sum();
            (sum / newest.len().max(1) as f64).into()
        };
        ViewFrame {
            cycle: self.captured,
            wrist: mean(|frame| frame.wrist),
            thumb: mean(|frame| frame.thumb),
            index: mean(|frame| frame.index),
            middle: mean(|frame| frame.middle),
        }
    }

    /// The newest frames, newest last.
    pub fn recent(&self) -> &[ViewFrame] {
        &self.recent[..self.frames as usize]
    }

    /// The hand's shape: the newest frames, averaged.
    pub fn shape(&self) -> ViewFrame {
        self.averaged(AVERAGED)
    }

    /// Speed of the hand over all frames that are kept, m/s; `None` while they are too few.
    pub fn steady_speed(&self) -> Option<f64> {
        let (first, last) = (self.recent[0], self.recent[FRAMES - 1]);
        let time = seconds(last.cycle.saturating_sub(first.cycle));
        let full = self.frames as usize == FRAMES && time > 0.0;
        let shown = self.shows_centre(0) && self.shows_centre(FRAMES - 1);
        full.then(|| {
            let wrist = Vector3::from(last.wrist) - Vector3::from(first.wrist);
            extent(wrist, shown.then(|| last.centre() - first.centre())) / time
        })
    }

    /// Where the middle between thumb and index tip is, m, and its velocity, m/s: as the filtered wrist, and against that as the newest frames show it
    /// on average. Single frames show fingers centimetres from where they are.
    pub fn steady_centre(&self) -> (Vector3<f64>, Vector3<f64>) {
        let frames = self.recent();
        if frames.len() < AVERAGED {
            return (self.centre(), Vector3::zeros());
        }
        let against = |frame: &ViewFrame| frame.centre() - Vector3::from(frame.wrist);
        let mean =
            |frames: &[ViewFrame]| frames.iter().map(against).sum::<Vector3<f64>>() / frames.len() as f64;
        let half = frames.len() / 2;
        let (early, late) = (&frames[..half], &frames[frames.len() - half..]);
        let time = seconds(late[0].cycle.saturating_sub(early[0].cycle)).max(SHORTEST_SPAN);
        let turning = (mean(late) - mean(early)) / time;
        let wrist = &self.joints[WRIST];
        (wrist.at(self.captured) + mean(late), wrist.velocity() + turning)
    }

    /// Middle between thumb and index tip, m: what the hand grasps lies there.
    pub fn centre(&self) -> Vector3<f64> {
        0.5 * (self.point(KeypointName::ThumbTip) + self.point(KeypointName::IndexTip))
    }

    /// Distance of thumb and index tip, m.
    pub fn aperture(&self) -> f64 {
        (self.point(KeypointName::ThumbTip) - self.point(KeypointName::IndexTip)).norm()
    }

    /// Tip of the index finger, m, and the unit vector along it; `None` while they are not known.
    pub fn index_finger(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let (knuckle, tip) = (KeypointName::IndexKnuckle, KeypointName::IndexTip);
        let known = self.is_known(knuckle) && self.is_known(tip);
        let along = (self.point(tip) - self.point(knuckle)).try_normalize(f64::EPSILON);
        along.filter(|_| known).map(|along| (self.point(tip), along))
    }

    /// By how much the tip of the index finger is farther from the wrist than that of the middle one, m.
    pub fn index_beyond_middle(&self) -> f64 {
        let shape = self.shape();
        let from_wrist = |tip: [f64; 3]| (Vector3::from(tip) - Vector3::from(shape.wrist)).norm();
        from_wrist(shape.index) - from_wrist(shape.middle)
    }

    /// Direction from wrist to the knuckles' middle against the table plane, rad; `None` while it cannot be seen,
    /// because knuckles were not found for long or because the keypoints are those of a flat image.
    pub fn pitch(&self) -> Option<f64> {
        let knuckles = [KeypointName::IndexKnuckle, KeypointName::LittleKnuckle];
        let is_recent = |name| self.age_of(name, self.captured).is_some_and(|age| age <= LONGEST_GAP);
        let are_recent = knuckles.into_iter().all(is_recent);
        (are_recent && !self.keypoints.are_flat()).then_some(self.pitch)
    }

    /// The pitch that the hand is turning to, rad.
    pub fn pitch_ahead(&self) -> Option<f64> {
        self.pitch()
            .map(|pitch| pitch + (self.pitch_rate * PITCH_AHEAD).clamp(-MOST_PITCH_AHEAD, MOST_PITCH_AHEAD))
    }

    fn raw_pitch(&self) -> f64 {
        let middle = (self.point(KeypointName::IndexKnuckle) + self.point(KeypointName::LittleKnuckle)) * 0.5;
        let line = middle - self.point(KeypointName::Wrist);
        line.z.atan2(line.x.hypot(line.y))
    }

    /// Filtered wrist position, extrapolated to `tick`, m.
    pub fn wrist_at(&self, tick: u64) -> Vector3<f64> {
        self.joints[WRIST].at(tick)
    }

    /// Filtered wrist velocity, m/s.
    pub fn velocity(&self) -> Vector3<f64> {
        self.joints[WRIST].velocity()
    }

    /// Shoulder, elbow, wrist and fingertip, each by itself.
    pub(super) fn joints(&self) -> &[TrackedJoint; JOINTS.len()] {
        &self.joints
    }

    /// Age of the newest usable frame, cycles; `u64::MAX` before the first.
    pub fn age(&self, tick: u64) -> u64 {
        if self.has_been_seen() { tick.saturating_sub(self.captured) } else { u64::MAX }
    }

    /// Refuses what is no state of a hand.
    pub fn check(&self) -> Result<(), Implausible> {
        self.keypoints.check()?;
        ensure(self.frames as usize <= FRAMES, "hand.frames", "no more frames than are kept")?;
        cycle("hand.captured", self.captured)?;
        self.joints.iter().try_for_each(TrackedJoint::check)?;
        finite("hand.pitch", &[self.pitch, self.pitch_rate])?;
        self.recent.iter().try_for_each(ViewFrame::check)?;
        self.movement.check()
    }

    /// Whether a usable frame of it has come.
    pub fn has_been_seen(&self) -> bool {
        self.seen > 0
    }

    /// Whether the newest frame is young enough to tell where the hand is now.
    pub fn is_tracked(&self, tick: u64) -> bool {
        self.age(tick) <= USABLE
    }

    /// Whether it has been tracked for so many frames that what it does is known.
    pub fn is_followed(&self, tick: u64) -> bool {
        self.is_tracked(tick) && self.frames == FRAMES as u64
    }

    /// Whether a keypoint has been found at least once.
    pub(super) fn is_known(&self, name: KeypointName) -> bool {
        self.keypoints.age_of(name, self.captured).is_some()
    }

    /// Whether the frame that came so many before the newest one shows the hand's centre itself.
    fn shows_centre(&self, before: usize) -> bool {
        self.centred >> before & 1 == 1
    }

    /// Cycles since a keypoint was found last; `None`: it never was.
    pub(super) fn age_of(&self, name: KeypointName, tick: u64) -> Option<u64> {
        self.keypoints.age_of(name, tick)
    }

    /// Where a keypoint was found last, and the wrist has taken it since, m.
    pub fn point(&self, name: KeypointName) -> Vector3<f64> {
        self.keypoints.place(name)
    }
}

/// The tip of the finger that reaches farthest from the wrist, m: the middle one's, which a frame shows there, unless the index is stretched out
/// alone.
fn fingertip(view: &HandView, middle: [f64; 3]) -> [f64; 3] {
    let [wrist, index] = [KeypointName::Wrist, KeypointName::IndexTip].map(|name| shown(view, name));
    let (Some(wrist), Some(index)) = (wrist, index) else { return middle };
    let reach = |tip: [f64; 3]| (Vector3::from(tip) - Vector3::from(wrist)).norm();
    if reach(index) > reach(middle) + ALONE { index } else { middle }
}
