use crate::{SceneView, Sighting};

/// A line that comes no farther than this along an axis, m, is parallel to the faces across it.
const PARALLEL: f64 = 1e-12;

impl SceneView {
    /// The recognised parts, as many as are valid.
    pub fn sightings(&self) -> &[Sighting] {
        &self.sighting[..(self.sightings as usize).min(self.sighting.len())]
    }

    /// The occluders that are valid: centre and half extents, m.
    pub fn occluders(&self) -> &[[f64; 6]] {
        &self.occluder[..(self.occluders as usize).min(self.occluder.len())]
    }

    /// Whether an eye at `eye` cannot see `place`, because an occluder, or what lies within `margin` of one, is between
    /// them; m.
    pub fn hides(&self, eye: [f64; 3], place: [f64; 3], margin: f64) -> bool {
        is_blocked(self.occluders(), eye, place, margin)
    }
}

/// Whether one of `boxes` (centre and half extents, each grown by `margin`) intersects the line from `eye` to `place`; m.
pub fn is_blocked(boxes: &[[f64; 6]], eye: [f64; 3], place: [f64; 3], margin: f64) -> bool {
    boxes.iter().any(|one| intersects(one, eye, place, margin))
}

/// Whether the line passes through the box: whether it is between all three pairs of its faces at once (the slab method,
/// Ericson 2005, 5.3.3). A box or a place that is not finite blocks nothing.
fn intersects(one: &[f64; 6], eye: [f64; 3], place: [f64; 3], margin: f64) -> bool {
    if !one.iter().chain(&place).all(|value| value.is_finite()) {
        return false;
    }
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let (from, way, half) = (eye[axis] - one[axis], place[axis] - eye[axis], one[axis + 3] + margin);
        if way.abs() < PARALLEL {
            if from.abs() > half {
                return false;
            }
            continue;
        }
        let (low, high) = ((-half - from) / way, (half - from) / way);
        enters = enters.max(low.min(high));
        leaves = leaves.min(low.max(high));
    }
    enters <= leaves
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [f64; 6] = [0.0, 0.0, 1.0, 0.1, 0.2, 0.3];
    const EYE: [f64; 3] = [2.0, 0.0, 1.0];

    #[test]
    fn what_lies_behind_or_in_a_box_is_hidden_and_nothing_else() {
        let hidden = |place| is_blocked(&[BOX], EYE, place, 0.0);
        assert!(hidden([-1.0, 0.0, 1.0]) && hidden([0.0, 0.0, 1.0]) && hidden([-1.0, 0.25, 0.8]));
        assert!(!hidden([0.5, 0.0, 1.0]), "before it");
        assert!(!hidden([-1.0, 0.5, 1.0]) && !hidden([-1.0, 0.0, 1.6]), "beside and above it");
        assert!(!is_blocked(&[], EYE, [-1.0, 0.0, 1.0], 0.0));
    }

    #[test]
    fn a_margin_hides_more_and_numbers_that_are_none_hide_nothing() {
        let beside = [0.0, 0.215, 1.0];
        assert!(!is_blocked(&[BOX], EYE, beside, 0.0) && is_blocked(&[BOX], EYE, beside, 0.02));
        assert!(!is_blocked(&[[f64::NAN; 6]], EYE, [3.0, 0.0, 1.0], 0.0));
        let mut view: SceneView = bytemuck::Zeroable::zeroed();
        view.occluder[0] = BOX;
        assert!(!view.hides(EYE, [-1.0, 0.0, 1.0], 0.0), "no occluder is valid");
        view.occluders = u32::MAX;
        assert!(view.hides(EYE, [-1.0, 0.0, 1.0], 0.0));
    }
}
