//! A recorded person's hand in place of the model's: while a recorded reach drives it.

use super::recorded::{LEAD, RecordedFrame, RecordedReach};
use super::{HandPose, Person, PersonMemory, Stage};
use coact_messages::{Keypoint, KeypointName};
use glam::DVec3;

/// How long after the grasp it leaves it again, ticks.
const TRAIL: u64 = 150;

impl Person {
    /// The recording that drives the hand now.
    pub(super) fn recording(&self, memory: &PersonMemory) -> Option<&RecordedReach> {
        let recorded = self.recorded.as_ref()?;
        memory.recording.get().and_then(|index| recorded.reaches.get(index))
    }

    /// The hand on a recorded way, `None` while the recording shows nothing.
    pub(super) fn recorded_pose(&self, memory: &PersonMemory, tick: u64) -> Option<HandPose> {
        let reach = self.recording(memory)?;
        let movement = &memory.movement;
        let frame = reach.at((tick as f64 - movement.onset as f64) * 1e-3)?;
        let mut pose = movement.pose(tick);
        let (from, to) = (movement.from.wrist(), movement.to.wrist());
        let along = frame.progress.clamp(0.0, 1.0);
        let arch = movement.arch * 16.0 * along * along * (1.0 - along) * (1.0 - along);
        let detour = frame.detour * self.model.thumb_side(&pose);
        pose.wrist = (from + frame.progress * (to - from) + detour + arch * DVec3::Z).into();
        Some(pose)
    }

    /// What a tracker of the recorded person would report at `tick`; `None` when the model alone shapes the hand.
    pub fn recorded_keypoints(&self, memory: &PersonMemory, tick: u64) -> Option<[Keypoint; 9]> {
        let reach = self.recording(memory)?;
        let begins = memory.movement.onset;
        let (onset, share) = match memory.stage() {
            Stage::Prepare => (begins, 1.0 - begins.saturating_sub(tick) as f64 / LEAD as f64),
            Stage::Reach => (begins, 1.0),
            _ => (memory.onset, 1.0 - tick.saturating_sub(memory.grasped) as f64 / TRAIL as f64),
        };
        if share <= 0.0 {
            return None;
        }
        let lost = [Keypoint::default(); 9];
        let frame = reach.at((tick as f64 - onset as f64) * 1e-3);
        Some(frame.map_or(lost, |frame| self.shaped(&memory.hand, &frame, share)))
    }

    /// The recorded shape of the hand in the plane of `pose`, mixed with the model's by its `share`.
    fn shaped(&self, pose: &HandPose, frame: &RecordedFrame, share: f64) -> [Keypoint; 9] {
        let modelled = self.model.keypoints(pose);
        let (ahead, aside, wrist) = (self.model.direction(pose), self.model.thumb_side(pose), pose.wrist());
        std::array::from_fn(|joint| {
            if frame.confidence[joint] <= 0.0 {
                return Keypoint::default();
            }
            let on_arm = joint == KeypointName::Shoulder as usize || joint == KeypointName::Elbow as usize;
            let shown = wrist + frame.shape[joint].x * ahead + frame.shape[joint].y * aside;
            let place = if on_arm { modelled[joint] } else { modelled[joint].lerp(shown, share.min(1.0)) };
            Keypoint { position: place.into(), confidence: frame.confidence[joint] }
        })
    }
}
