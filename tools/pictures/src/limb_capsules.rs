use coact_messages::KeypointName::{
    self, Elbow, IndexKnuckle, IndexTip, LittleKnuckle, MiddleTip, PalmBase, Shoulder, ThumbTip, Wrist,
};
use coact_motion::Capsule;
use coact_run_records::KEYPOINTS;

/// Limbs of the person's arm and hand: from, to, and the radius with which they are drawn, m. Chosen by hand, about as
/// thick as a slender adult's; for the eye only.
const LIMBS: [(KeypointName, KeypointName, f64); 9] = [
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

/// Capsules around the limbs of the person's arm and hand whose both ends were seen; keypoints in m, in the order of
/// [`KeypointName`].
pub(crate) fn limb_capsules(keypoints: &[Option<[f64; 3]>; KEYPOINTS]) -> impl Iterator<Item = Capsule> {
    LIMBS.iter().filter_map(|&(from, to, radius)| {
        let (start, end) = (keypoints[from as usize]?.into(), keypoints[to as usize]?.into());
        Some(Capsule { start, end, radius })
    })
}
