use coact_messages::Sighting;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// A quaternion shorter than this has no direction: an orientation that was never estimated is zero.
pub const SHORTEST: f64 = 1e-3;

/// Frame of a part as the recogniser has seen it; none when its numbers are no frame.
pub fn frame_of(sighting: &Sighting) -> Option<Isometry3<f64>> {
    let [x, y, z, w] = sighting.orientation;
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), SHORTEST)?;
    let frame = Isometry3::from_parts(Translation3::from(sighting.position), turn);
    frame.translation.vector.iter().all(|value| value.is_finite()).then_some(frame)
}
