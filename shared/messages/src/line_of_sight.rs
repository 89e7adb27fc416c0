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

/// Whether something long and round, as thick as `radius` around the line between two points, stands between `eye` and `place`; m. What is not finite
/// blocks nothing.
pub fn is_blocked_by_limb(limb: [[f64; 3]; 2], radius: f64, eye: [f64; 3], place: [f64; 3]) -> bool {
    least_distance(limb, [eye, place]) < radius
}

/// Least distance of two line segments (Ericson 2005, 5.1.9); NaN where a number is none.
fn least_distance([from, to]: [[f64; 3]; 2], [eye, place]: [[f64; 3]; 2]) -> f64 {
    let way = |one: [f64; 3], other: [f64; 3]| [0, 1, 2].map(|axis| other[axis] - one[axis]);
    let dot = |one: [f64; 3], other: [f64; 3]| (0..3).map(|axis| one[axis] * other[axis]).sum::<f64>();
    let (limb, sight, between) = (way(from, to), way(eye, place), way(eye, from));
    let (a, e, f) = (dot(limb, limb), dot(sight, sight).max(PARALLEL), dot(sight, between));
    let (b, c) = (dot(limb, sight), dot(limb, between));
    let denominator = a * e - b * b;
    let nearest = if denominator > PARALLEL { ((b * f - c * e) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let along_sight = ((b * nearest + f) / e).clamp(0.0, 1.0);
    let along_limb = ((b * along_sight - c) / a.max(PARALLEL)).clamp(0.0, 1.0);
    let apart = [0, 1, 2].map(|axis| between[axis] + along_limb * limb[axis] - along_sight * sight[axis]);
    dot(apart, apart).sqrt()
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
    fn a_limb_hides_what_lies_behind_it_and_nothing_beside_or_before_it() {
        let forearm = [[-0.2, 0.0, 1.3], [0.0, 0.0, 1.1]];
        let hidden = |place| is_blocked_by_limb(forearm, 0.04, EYE, place);
        assert!(hidden([-1.0, 0.0, 1.15]) && hidden([-0.1, 0.0, 1.2]), "behind, and within");
        assert!(!hidden([0.5, 0.0, 1.1]), "before it");
        assert!(!hidden([-1.0, 0.2, 1.15]) && !hidden([-1.0, 0.0, 0.9]), "beside and below it");
        assert!(!hidden([f64::NAN, 0.0, 1.15]));
        let nothing = [[0.0, 0.0, 1.0]; 2];
        assert!(is_blocked_by_limb(nothing, 0.04, EYE, [-1.0, 0.0, 1.0]), "as thick as it is long");
    }

    #[test]
    fn the_least_distance_of_two_lines_is_that_of_their_nearest_points() {
        // Against the nearest of many points on both, for lines that cross, pass, or end short of each other.
        let place =
            |seed: u64| [0, 1, 2].map(|axis| ((seed * 7919 + axis * 104_729) % 1000) as f64 / 500.0 - 1.0);
        for seed in 0..200 {
            let [limb, sight] =
                [[place(4 * seed), place(4 * seed + 1)], [place(4 * seed + 2), place(4 * seed + 3)]];
            let at = |line: [[f64; 3]; 2], step: u32| {
                let along = f64::from(step) / 200.0;
                [0, 1, 2].map(|axis| line[0][axis] + along * (line[1][axis] - line[0][axis]))
            };
            let apart = |one: [f64; 3], other: [f64; 3]| {
                (0..3).map(|axis| (one[axis] - other[axis]).powi(2)).sum::<f64>().sqrt()
            };
            let pairs = (0..=200).flat_map(|one| (0..=200).map(move |other| (one, other)));
            let nearest =
                pairs.map(|(one, other)| apart(at(limb, one), at(sight, other))).fold(f64::MAX, f64::min);
            let found = least_distance(limb, sight);
            assert!(found <= nearest + 1e-9 && nearest < found + 0.02, "{seed}: {found}, {nearest}");
        }
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
