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
    /// How far it is off the straight line, m, towards the thumb's side.
    pub detour: f64,
    /// Keypoints against the wrist: along the hand (wrist to knuckles), and across it (towards the thumb), m.
    pub shape: [DVec2; 9],
    pub confidence: [f64; 9],
}

impl RecordedReach {
    /// `None` when the wrist cannot be followed from before the onset to the grasp.
    pub fn new(reach: &Reach, scale: f64) -> Option<Self> {
        let wrists = followed(reach)?;
        let at_time = |time: f64| {
            let distance = |index: &usize| (reach.frames[*index].time - time).abs();
            (0..reach.frames.len()).min_by(|one, other| distance(one).total_cmp(&distance(other)))
        };
        let (start, end) = (at_time(-PERIOD_S * LEAD as f64)?, at_time(reach.movement_time)?);
        let displacement = wrists[end] - wrists[start];
        let (ahead, across) = hand_axes(&reach.frames[end], wrists[end])?;
        if displacement.length() < SHORTEST {
            return None;
        }
        // The thumb's side of the path is where the thumb's side of the hand is at the end of it.
        let normal = displacement.perp();
        let side = if normal.dot(across) > 0.0 { normal } else { -normal }.normalize();
        let mut shape = [DVec2::ZERO; 9];
        let frames: Vec<_> = (0..reach.frames.len())
            .map(|index| {
                let (frame, moved) = (&reach.frames[index], wrists[index] - wrists[start]);
                see_joints(frame, wrists[index], (ahead, across), scale, &mut shape);
                RecordedFrame {
                    time: frame.time,
                    progress: moved.dot(displacement) / displacement.length_squared(),
                    detour: scale * moved.dot(side),
                    shape,
                    confidence: frame.joints.map(|joint| joint.confidence.clamp(0.0, 1.0)),
                }
            })
            .collect();
        let tips = &frames[end].shape;
        let centre = 0.5 * (tips[KeypointName::ThumbTip as usize] + tips[KeypointName::IndexTip as usize]);
        let movement_time = (reach.movement_time * CYCLES_PER_SECOND as f64).round() as u64;
        Some(Self { width: reach.size.width(), movement_time, centre, frames })
    }

    /// The hand `time` s after onset, between the recording's frames; where frames are lost, no joint is seen. `None` before the first frame and
    /// after the last.
    pub fn at(&self, time: f64) -> Option<RecordedFrame> {
        let next = self.frames.partition_point(|frame| frame.time <= time);
        let before = self.frames.get(next.checked_sub(1)?)?;
        let after = self.frames.get(next)?;
        let gap = after.time - before.time;
        let along = ((time - before.time) / gap.max(1e-9)).clamp(0.0, 1.0);
        let mixed = before.mixed_with(after, along);
        let confidence = if gap > LOST { [0.0; 9] } else { mixed.confidence };
        Some(RecordedFrame { time, confidence, ..mixed })
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
            confidence: if along < 0.5 { self.confidence } else { other.confidence },
        }
    }
}

/// The wrist in every frame, pixels; where it is lost, where it was last seen.
fn followed(reach: &Reach) -> Option<Vec<DVec2>> {
    let seen = |frame: &Frame| {
        let wrist = frame.joints[KeypointName::Wrist as usize];
        (wrist.confidence > 0.0).then(|| DVec2::new(wrist.x, wrist.y))
    };
    let mut last = reach.frames.iter().find_map(seen)?;
    let follow = |frame: &Frame| {
        last = seen(frame).unwrap_or(last);
        last
    };
    Some(reach.frames.iter().map(follow).collect())
}

/// Directions on the image: from the wrist to the middle of the knuckles, and across it to the thumb's side.
fn hand_axes(frame: &Frame, wrist: DVec2) -> Option<(DVec2, DVec2)> {
    let point = |name: KeypointName| {
        let joint = frame.joints[name as usize];
        (joint.confidence > 0.0).then(|| DVec2::new(joint.x, joint.y))
    };
    let (index, little) = (point(KeypointName::IndexKnuckle)?, point(KeypointName::LittleKnuckle)?);
    point(KeypointName::ThumbTip)?;
    point(KeypointName::IndexTip)?;
    let ahead = (0.5 * (index + little) - wrist).try_normalize()?;
    let across = if (index - little).dot(ahead.perp()) > 0.0 { ahead.perp() } else { -ahead.perp() };
    Some((ahead, across))
}

/// Corrects the shape of the hand by the joints that are seen in this frame; lost ones stay where they were last seen.
fn see_joints(
    frame: &Frame,
    wrist: DVec2,
    (ahead, across): (DVec2, DVec2),
    scale: f64,
    shape: &mut [DVec2; 9],
) {
    for (place, joint) in shape.iter_mut().zip(&frame.joints).filter(|(_, joint)| joint.confidence > 0.0) {
        let reached = DVec2::new(joint.x, joint.y) - wrist;
        *place = scale * DVec2::new(reached.dot(ahead), reached.dot(across));
    }
}
