use coact_messages::KeypointName::{
    self, Elbow, IndexKnuckle, IndexTip, LittleKnuckle, MiddleTip, PalmBase, Shoulder, ThumbTip, Wrist,
};
use coact_motion::Capsule;

/// Bones of the person's arm and hand: from, to, and how thick they are drawn, m.
const BONES: [(KeypointName, KeypointName, f64); 9] = [
    (Shoulder, Elbow, 0.045),
    (Elbow, Wrist, 0.035),
    (Wrist, PalmBase, 0.022),
    (PalmBase, IndexKnuckle, 0.016),
    (PalmBase, LittleKnuckle, 0.016),
    (IndexKnuckle, LittleKnuckle, 0.014),
    (PalmBase, ThumbTip, 0.011),
    (IndexKnuckle, IndexTip, 0.010),
    (PalmBase, MiddleTip, 0.010),
];

/// The person's arm and hand, of what was seen of them: places in m, in the order of [`KeypointName`].
pub(crate) fn arm_and_hand(keypoints: &[Option<[f64; 3]>; 9]) -> impl Iterator<Item = Capsule> {
    BONES.iter().filter_map(|&(from, to, radius)| {
        let (start, end) = (keypoints[from as usize]?.into(), keypoints[to as usize]?.into());
        Some(Capsule { start, end, radius })
    })
}
