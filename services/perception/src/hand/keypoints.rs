use bytemuck::{Pod, Zeroable};
use coact_messages::{HandView, KeypointName};
use coact_stage_state::{Implausible, ensure};
use nalgebra::Vector3;

/// Confidence above which a keypoint is believed.
///
/// Of 540 378 keypoints of the recorded reaches, 3.5 % have a confidence above 0 and up to this one. They lie 3.3 pixels
/// (median) off the line between their sure neighbours in time, the last sure ones 1.8: what was seen before is nearer. From
/// 0.2 to 0.3 both are about equal (2.3, 1.9), above that the new one is nearer (1.3, 1.5). With this threshold 84.0 % of the
/// reaches are understood before contact, with none 82.9 %. The simulated tracker says 0, or 0.7 to 0.95.
pub(crate) const BELIEVED: f64 = 0.2;
/// How far a keypoint may lie from the origin, m: no hand beyond it concerns the robot, the tracker is mistaken.
const FARTHEST: f64 = 10.0;
/// Keypoints of a frame.
const KEYPOINTS: usize = 9;
/// Difference in height, m, below which keypoints are those of a flat image: recordings of one camera have none.
const FLAT: f64 = 1e-6;

/// All of them.
pub(super) const ALL: [KeypointName; KEYPOINTS] = [
    KeypointName::Shoulder,
    KeypointName::Elbow,
    KeypointName::Wrist,
    KeypointName::PalmBase,
    KeypointName::ThumbTip,
    KeypointName::IndexKnuckle,
    KeypointName::IndexTip,
    KeypointName::MiddleTip,
    KeypointName::LittleKnuckle,
];

/// Where each keypoint of a person's arm was found last.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Keypoints {
    /// Cycle of the frame that showed each last, plus one; 0: none did.
    found: [u64; KEYPOINTS],
    /// Where that was, and the wrist has taken those of the hand since, m.
    place: [[f64; 3]; KEYPOINTS],
}

impl Keypoints {
    /// Puts each of these that the frame shows in its place. False when it shows none of them.
    pub fn take_in(&mut self, view: &HandView, names: &[KeypointName]) -> bool {
        let mut any = false;
        for name in names {
            if let Some(place) = shown(view, *name) {
                self.place[*name as usize] = place;
                self.found[*name as usize] = view.captured_cycle.saturating_add(1);
                any = true;
            }
        }
        any
    }

    /// What the frame captured then does not show of the hand has come along with the wrist, which has moved so, m.
    pub fn take_along(&mut self, moved: Vector3<f64>, captured: u64) {
        let hand = KeypointName::PalmBase as usize..=KeypointName::LittleKnuckle as usize;
        for index in hand.filter(|index| self.found[*index] <= captured) {
            let along = (Vector3::from(self.place[index]) + moved).into();
            if is_near(&along) {
                self.place[index] = along;
            }
        }
    }

    /// Where one was found last, and the wrist has taken it since, m.
    pub fn place(&self, name: KeypointName) -> Vector3<f64> {
        self.place[name as usize].into()
    }

    /// Cycles since one was found last; `None`: it never was.
    pub fn age_of(&self, name: KeypointName, tick: u64) -> Option<u64> {
        self.found[name as usize].checked_sub(1).map(|cycle| tick.saturating_sub(cycle))
    }

    /// Whether they are those of a flat image, which tells no heights.
    pub fn are_flat(&self) -> bool {
        let wrist = self.place[KeypointName::Wrist as usize][2];
        self.place.iter().all(|place| (place[2] - wrist).abs() <= FLAT)
    }

    /// Refuses what is none.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.place.iter().all(is_near), "hand.keypoint", "positions near the robot")
    }
}

/// Where a frame shows a keypoint, m, if it is to be believed.
pub(super) fn shown(view: &HandView, name: KeypointName) -> Option<[f64; 3]> {
    let keypoint = &view.keypoints[name as usize];
    (keypoint.confidence > BELIEVED && is_near(&keypoint.position)).then_some(keypoint.position)
}

fn is_near(place: &[f64; 3]) -> bool {
    place.iter().all(|value| value.abs() < FARTHEST)
}
