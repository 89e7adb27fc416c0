/// A line that comes no farther than this along an axis, m, is parallel to the faces across it.
const PARALLEL: f64 = 1e-12;

/// How far along the line from `eye` to `place` a box (centre and half extents, each grown by `margin`, m) is met, as a fraction of it; `None` if
/// it is not: where the line is between all three pairs of its faces at once (the slab method, Ericson 2005, 5.3.3). What is not finite is
/// met nowhere.
pub fn box_before(one: &[f64; 6], eye: [f64; 3], place: [f64; 3], margin: f64) -> Option<f64> {
    if !one.iter().chain(&place).all(|value| value.is_finite()) {
        return None;
    }
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let (from, way, half) = (eye[axis] - one[axis], place[axis] - eye[axis], one[axis + 3] + margin);
        if way.abs() < PARALLEL {
            if from.abs() > half {
                return None;
            }
            continue;
        }
        let (low, high) = ((-half - from) / way, (half - from) / way);
        enters = enters.max(low.min(high));
        leaves = leaves.min(low.max(high));
    }
    (enters <= leaves).then_some(enters)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [f64; 6] = [0.0, 0.0, 1.0, 0.1, 0.2, 0.3];
    const EYE: [f64; 3] = [2.0, 0.0, 1.0];

    #[test]
    fn what_lies_behind_or_in_a_box_is_hidden_and_nothing_else() {
        let hidden = |place| box_before(&BOX, EYE, place, 0.0).is_some();
        assert!(hidden([-1.0, 0.0, 1.0]) && hidden([0.0, 0.0, 1.0]) && hidden([-1.0, 0.25, 0.8]));
        assert!(!hidden([0.5, 0.0, 1.0]), "before it");
        assert!(!hidden([-1.0, 0.5, 1.0]) && !hidden([-1.0, 0.0, 1.6]), "beside and above it");
        let met = box_before(&BOX, EYE, [-1.0, 0.0, 1.0], 0.0).unwrap_or(f64::NAN);
        assert!((met - 1.9 / 3.0).abs() < 1e-9, "at its face: {met}");
    }

    #[test]
    fn a_margin_hides_more_and_numbers_that_are_none_hide_nothing() {
        let beside = [0.0, 0.215, 1.0];
        let hidden = |one: &[f64; 6], place, margin| box_before(one, EYE, place, margin).is_some();
        assert!(!hidden(&BOX, beside, 0.0) && hidden(&BOX, beside, 0.02));
        assert!(!hidden(&[f64::NAN; 6], [3.0, 0.0, 1.0], 0.0));
    }
}
