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
}

impl Fingers {
    pub fn of(points: &[DVec3; 9]) -> Self {
        let at = |name: KeypointName| points[name as usize];
        let (thumb, index) = (at(KeypointName::ThumbTip), at(KeypointName::IndexTip));
        let knuckles = at(KeypointName::IndexKnuckle).midpoint(at(KeypointName::LittleKnuckle));
        let ahead = knuckles - at(KeypointName::Wrist);
        Self {
            middle: thumb.midpoint(index),
            aperture: thumb.distance(index),
            pitch: ahead.z.atan2(ahead.truncate().length()),
        }
    }
}
