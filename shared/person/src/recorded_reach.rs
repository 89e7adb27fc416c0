use coact_messages::KeypointName;
use coact_period::{CYCLES_PER_SECOND, PERIOD_S, cycles};
use coact_recordings::{Frame, Reach};
use glam::DVec2;
use std::time::Duration;

/// How long before its onset a recorded reach takes the hand over, cycles. The recordings begin half a second before it.
pub(crate) const LEAD: u64 = cycles(Duration::from_millis(300));
/// Shortest displacement of the wrist on the image that says where a reach leads, pixels: several times the detector's
/// jitter.
const SHORTEST: f64 = 10.0;
/// Frames further apart than this have lost frames between them, s: more than two frames of 60 Hz.
const LOST: f64 = 0.04;
/// Frames of which the median is taken: in single ones the detector is mistaken.
const STEADY: usize = 5;
/// No wrist goes faster, and no joint against its wrist, m/s: more than twice as fast as the recorded reaches are.
const FASTEST: f64 = 3.0;

/// One recorded reach, apart from where it began and ended.
#[derive(Debug, Clone)]
pub(crate) struct RecordedReach {
    /// Width of what was grasped, m.
    pub width: f64,
    /// Onset to the end of the grasp, cycles.
    pub movement_time: u64,
    /// Middle between thumb and index tip at the end, in the hand's plane, m: along and across.
    pub centre: DVec2,
    frames: Vec<RecordedFrame>,
}

/// One frame, in the plane of the hand.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RecordedFrame {
    /// Since onset, s.
    time: f64,
    /// Fraction of the displacement that the wrist has covered.
    pub progress: f64,
    /// How far it is off the straight line, towards the thumb's side, as a fraction of the displacement's length.
    pub detour: f64,
    /// Joints against the wrist: along the hand (wrist to knuckles), and across it (towards the thumb), m.
    pub shape: [DVec2; 9],
    /// The same as the detector reports it, who is mistaken now and then.
    pub reported: [DVec2; 9],
    pub confidence: [f64; 9],
}

impl RecordedReach {
    /// `None` when the wrist cannot be followed from before the onset to the grasp.
    pub fn new(reach: &Reach, scale: f64) -> Option<Self> {
        let frames = &reach.frames;
        let wrist = KeypointName::Wrist as usize;
        let wrists = steady(frames, FASTEST / scale, |frame| seen(&frames[frame], wrist))?;
        let at_time = |time: f64| {
            let distance = |index: &usize| (frames[*index].time - time).abs();
            (0..frames.len()).min_by(|one, other| distance(one).total_cmp(&distance(other)))
        };
        let (start, end) = (at_time(-PERIOD_S * LEAD as f64)?, at_time(reach.movement_time)?);
        let displacement = wrists[end] - wrists[start];
        let (ahead, across) = hand_axes(&frames[end], wrists[end])?;
        if displacement.length() < SHORTEST {
            return None;
        }
        // The thumb's side of the path is where the thumb's side of the hand is at the end of it.
        let normal = displacement.perp();
        let side = if normal.dot(across) > 0.0 { normal } else { -normal }.normalize();
        let reported = |frame: usize, joint: usize| {
            let reached = seen(&frames[frame], joint)? - wrists[frame];
            Some(scale * DVec2::new(reached.dot(ahead), reached.dot(across)))
        };
        let shapes = shapes(frames, reported);
        let recorded = |index: usize| {
            let moved = wrists[index] - wrists[start];
            RecordedFrame {
                time: frames[index].time,
                progress: moved.dot(displacement) / displacement.length_squared(),
                detour: moved.dot(side) / displacement.length(),
                shape: std::array::from_fn(|joint| shapes[joint][index]),
                reported: std::array::from_fn(|joint| reported(index, joint).unwrap_or(shapes[joint][index])),
                confidence: frames[index].joints.map(|joint| joint.confidence.clamp(0.0, 1.0)),
            }
        };
        let [thumb, finger] =
            [KeypointName::ThumbTip, KeypointName::IndexTip].map(|tip| shapes[tip as usize][end]);
        Some(Self {
            width: reach.size.width(),
            movement_time: (reach.movement_time * CYCLES_PER_SECOND as f64).round() as u64,
            centre: 0.5 * (thumb + finger),
            frames: (0..frames.len()).map(recorded).collect(),
        })
    }

    /// The hand `time` s after onset, between the recording's frames. Where frames are lost, before the first one and after the last, no joint
    /// is seen; the hand is as in the nearest ones.
    pub fn at(&self, time: f64) -> RecordedFrame {
        let next = self.frames.partition_point(|frame| frame.time <= time);
        let (before, after) =
            (&self.frames[next.saturating_sub(1)], &self.frames[next.min(self.frames.len() - 1)]);
        let gap = after.time - before.time;
        let along = ((time - before.time) / gap.max(1e-9)).clamp(0.0, 1.0);
        let mixed = before.mixed_with(after, along);
        let is_seen = 0.0 < gap && gap <= LOST;
        RecordedFrame { time, confidence: if is_seen { mixed.confidence } else { [0.0; 9] }, ..mixed }
    }
}

impl RecordedFrame {
    /// What lies at fraction `along` of the way from this frame to another one; keypoints are as sure as in the nearer one.
    pub fn mixed_with(&self, other: &Self, along: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * along;
        Self {
            time: mix(self.time, other.time),
            progress: mix(self.progress, other.progress),
            detour: mix(self.detour, other.detour),
            shape: std::array::from_fn(|joint| self.shape[joint].lerp(other.shape[joint], along)),
            reported: std::array::from_fn(|joint| self.reported[joint].lerp(other.reported[joint], along)),
            confidence: if along < 0.5 { self.confidence } else { other.confidence },
        }
    }
}

/// Where a frame shows a joint, pixels.
fn seen(frame: &Frame, joint: usize) -> Option<DVec2> {
    let joint = frame.joints[joint];
    (joint.confidence > 0.0).then(|| DVec2::new(joint.x, joint.y))
}

/// Each joint against the wrist in all frames, from where the detector reports it; one that is never seen is at the wrist.
fn shapes(frames: &[Frame], reported: impl Fn(usize, usize) -> Option<DVec2>) -> [Vec<DVec2>; 9] {
    let at_wrist = || vec![DVec2::ZERO; frames.len()];
    let mut shapes: [_; 9] = std::array::from_fn(|joint| {
        steady(frames, FASTEST, |frame| reported(frame, joint)).unwrap_or_else(at_wrist)
    });
    shapes[KeypointName::Wrist as usize] = at_wrist();
    shapes
}

/// Where something is in all frames of which some show it: the median of the [`STEADY`] around that do, no farther from one to the next than it
/// can go at so many units a second; where it is lost, on the way from where it was last to where it is next. `None` for what is never shown.
fn steady(frames: &[Frame], fastest: f64, shown: impl Fn(usize) -> Option<DVec2>) -> Option<Vec<DVec2>> {
    let shown: Vec<(f64, DVec2)> =
        (0..frames.len()).filter_map(|index| Some((frames[index].time, shown(index)?))).collect();
    let last = shown.len().checked_sub(1)?;
    let mut known: Vec<(f64, DVec2)> = Vec::with_capacity(shown.len());
    for (index, (time, _)) in shown.iter().enumerate() {
        let beside = (STEADY / 2).min(index).min(last - index);
        let around = &shown[index - beside..=index + beside];
        let place = DVec2::new(median(around, |place| place.x), median(around, |place| place.y));
        let (before, from) = *known.last().unwrap_or(&(*time, place));
        known.push((*time, from + (place - from).clamp_length_max(fastest * (time - before))));
    }
    let at = |frame: &Frame| {
        let next = known.partition_point(|(time, _)| *time < frame.time);
        let ((from, before), (to, after)) = (known[next.saturating_sub(1)], known[next.min(last)]);
        before.lerp(after, ((frame.time - from) / (to - from).max(1e-9)).clamp(0.0, 1.0))
    };
    Some(frames.iter().map(at).collect())
}

fn median(around: &[(f64, DVec2)], coordinate: impl Fn(DVec2) -> f64) -> f64 {
    let mut all: Vec<f64> = around.iter().map(|(_, place)| coordinate(*place)).collect();
    all.sort_unstable_by(f64::total_cmp);
    all[all.len() / 2]
}

/// Directions on the image: from the wrist to the middle of the knuckles, and across it to the thumb's side.
fn hand_axes(frame: &Frame, wrist: DVec2) -> Option<(DVec2, DVec2)> {
    let point = |name: KeypointName| seen(frame, name as usize);
    let (index, little) = (point(KeypointName::IndexKnuckle)?, point(KeypointName::LittleKnuckle)?);
    point(KeypointName::ThumbTip)?;
    point(KeypointName::IndexTip)?;
    let ahead = (0.5 * (index + little) - wrist).try_normalize()?;
    let across = if (index - little).dot(ahead.perp()) > 0.0 { ahead.perp() } else { -ahead.perp() };
    Some((ahead, across))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_recordings::{ImagePoint, Size};

    /// A wrist that goes 60 px to the right in 0.6 s, and 9 px aside on its way.
    fn bent() -> Reach {
        let hand = [
            (-60., 0.),
            (-32., 0.),
            (0., 0.),
            (3., 3.),
            (18., 9.),
            (12., 4.),
            (18., 0.),
            (20., -2.),
            (10., -5.),
        ];
        let frame = |index: i32| {
            let time = f64::from(index) / 60.0;
            let along = (time / 0.6).clamp(0.0, 1.0);
            let (x, y) = (100.0 + 60.0 * along, 50.0 + 36.0 * along * (1.0 - along));
            Frame { time, joints: hand.map(|(dx, dy)| ImagePoint { x: x + dx, y: y + dy, confidence: 0.8 }) }
        };
        let frames = (-30..60).map(frame).collect();
        Reach { participant: 1, size: Size::Medium, trial: 1, movement_time: 0.6, frames }
    }

    #[test]
    fn a_detour_is_in_proportion_to_the_way_whatever_the_size_of_the_hand() {
        let most = |scale: f64| {
            let reach = RecordedReach::new(&bent(), scale).unwrap();
            let detours = reach.frames.iter().map(|frame| frame.detour);
            (detours.fold(0.0, f64::max), reach.centre.length())
        };
        let ((detour, hand), (of_larger, larger)) = (most(0.001), most(0.002));
        assert!((detour - 0.15).abs() < 0.01, "{detour} of the way");
        assert!((detour - of_larger).abs() < 1e-12 && (larger / hand - 2.0).abs() < 1e-9);
    }
}
