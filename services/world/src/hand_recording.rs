use crate::WorldError;
use coact_messages::{ArmSide, HandPoints, HandView, Plausible};
use coact_run_recording::{Recorded, Recording, RecordingError};
use std::path::Path;

/// What is shown again.
const RIGHT: usize = ArmSide::Right as usize;

/// Where a person's right hand was in a run that was recorded: as its cameras saw it, frame by frame.
///
/// The tracker's scatter is in it; shown to a tracker again, it scatters twice.
#[derive(Debug, Clone)]
pub struct HandRecording {
    /// Cycle of capture, and the nine keypoints, m; in the order of time.
    frames: Vec<(u64, [[f64; 3]; 9])>,
}

impl HandRecording {
    /// What the recording of a run ends with.
    pub(crate) const EXTENSION: &str = ".mcap";

    /// Reads all frames of a recording in which the whole arm and hand were seen. Of one that is truncated those up to its end.
    ///
    /// # Errors
    /// It is no recording, or shows no hand.
    pub fn load(path: &Path) -> Result<Self, WorldError> {
        let error = |cause: RecordingError| WorldError::Recording { message: cause.to_string() };
        let mut recording = Recording::open(path).map_err(error)?;
        let mut frames: Vec<(u64, [[f64; 3]; 9])> = Vec::new();
        while let Some(message) = recording.next_message().map_err(error)? {
            let Recorded::Sample(sample) = message else { continue };
            let is_new = frames.last().is_none_or(|(last, _)| sample.hands[RIGHT].captured_cycle > *last);
            let hand = Some(&sample.hands[RIGHT]).filter(|_| is_new);
            frames.extend(hand.and_then(|hand| Some((hand.captured_cycle, whole_hand(hand)?))));
        }
        if frames.is_empty() {
            let message = format!("{}: shows no hand; expected a run in which one was seen", path.display());
            return Err(WorldError::Recording { message });
        }
        Ok(Self { frames })
    }

    /// The keypoints that were captured in this cycle, if any were, m.
    pub(crate) fn captured_in(&self, cycle: u64) -> Option<&[[f64; 3]; 9]> {
        let found = self.frames.binary_search_by_key(&cycle, |(captured, _)| *captured).ok()?;
        Some(&self.frames[found].1)
    }
}

/// The keypoints of a frame that shows all of them, if they are those of an arm.
fn whole_hand(hand: &HandView) -> Option<[[f64; 3]; 9]> {
    let all = hand.keypoints.iter().all(|keypoint| keypoint.confidence > 0.0);
    let position = hand.keypoints.map(|keypoint| keypoint.position);
    let is_one = HandPoints { position, ..bytemuck::Zeroable::zeroed() }.check().is_ok();
    (all && is_one).then_some(position)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::{LAYOUT, SensorSample};
    use coact_person::HandModel;
    use coact_run_recording::{Origin, RecordingWriter};
    use glam::DVec3;

    #[test]
    fn the_frames_that_show_a_whole_hand_come_again_in_their_cycles() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.mcap");
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let model = HandModel::new(&coact_joint_task::Task::load(&shipped).unwrap().scene);
        let mut writer = RecordingWriter::create(&path, &Origin::default()).unwrap();
        for cycle in 0..60 {
            let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
            (sample.header.layout, sample.header.cycle) = (LAYOUT, cycle + 20);
            sample.hands[RIGHT].captured_cycle = cycle / 17 * 17;
            let points = model.reaching(DVec3::new(-0.9, 0.01 * (cycle / 17) as f64, 0.9), -1.0, 0.05);
            for (keypoint, point) in sample.hands[RIGHT].keypoints.iter_mut().zip(points) {
                (keypoint.position, keypoint.confidence) = (point.to_array(), 1.0);
            }
            // The wrist is lost in the third frame.
            sample.hands[RIGHT].keypoints[2].confidence = if cycle / 17 == 2 { 0.0 } else { 1.0 };
            writer.message(&Recorded::Sample(sample)).unwrap();
        }
        writer.finish(&Default::default()).unwrap();
        let recording = HandRecording::load(&path).unwrap();
        let seen: Vec<u64> = (0..80).filter(|cycle| recording.captured_in(*cycle).is_some()).collect();
        assert_eq!(seen, [0, 17, 51]);
        let empty = folder.path().join("empty.mcap");
        RecordingWriter::create(&empty, &Origin::default()).unwrap().finish(&Default::default()).unwrap();
        assert!(HandRecording::load(&empty).unwrap_err().to_string().contains("shows no hand"));
        assert!(HandRecording::load(&shipped).is_err());
    }
}
