use crate::hand::ViewFrame;
use nalgebra::Vector3;

/// Length of a feature vector.
pub const FEATURES: usize = 3;

/// What is read from the hand at one instant, m: thumb to middle tip, wrist to thumb tip, and the wrist's displacement
/// since it lay still. All are lengths: they are the same however the camera stands.
pub type Features = [f64; FEATURES];

/// Features of a hand's averaged frame, on a reach that began at `anchor`.
pub(crate) fn features(shape: &ViewFrame, anchor: [f64; 3]) -> Features {
    let distance = |a: [f64; 3], b: [f64; 3]| (Vector3::from(a) - Vector3::from(b)).norm();
    [distance(shape.thumb, shape.middle), distance(shape.wrist, shape.thumb), distance(shape.wrist, anchor)]
}
