use coact_messages::KeypointName;
use glam::DVec3;

/// What the keypoints of a hand say about its fingers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fingers {
    /// The middle between thumb and index tip, m.
    pub middle: DVec3,
    /// Distance of thumb and index tip, m.
    pub aperture: f64,
    /// Direction from the wrist to the middle of the knuckles against the table plane, rad.
    pub pitch: f64,
    /// Tip of the index finger, m, and the unit vector along it, when it is stretched out alone.
    pub points: Option<(DVec3, DVec3)>,
}

/// The index finger is stretched out alone when its tip is this much farther from the wrist than the middle finger's, m. Chosen by hand.
const ALONE: f64 = 0.05;

impl Fingers {
    pub fn of(points: &[DVec3; 9]) -> Self {
        let at = |name: KeypointName| points[name as usize];
        let (thumb, index) = (at(KeypointName::ThumbTip), at(KeypointName::IndexTip));
        let knuckles = at(KeypointName::IndexKnuckle).midpoint(at(KeypointName::LittleKnuckle));
        let wrist = at(KeypointName::Wrist);
        let ahead = knuckles - wrist;
        let alone = index.distance(wrist) - at(KeypointName::MiddleTip).distance(wrist) > ALONE;
        let along = (index - at(KeypointName::IndexKnuckle)).try_normalize();
        Self {
            middle: thumb.midpoint(index),
            aperture: thumb.distance(index),
            pitch: ahead.z.atan2(ahead.truncate().length()),
            points: along.filter(|_| alone).map(|along| (index, along)),
        }
    }
}
