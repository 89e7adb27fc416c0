use crate::{SceneView, Sighting};

/// A line that comes no farther than this along an axis, m, is parallel to the faces across it.
const PARALLEL: f64 = 1e-12;

impl SceneView {
    /// The recognised parts, as many as are valid.
    pub fn sightings(&self) -> &[Sighting] {
        &self.sighting[..(self.sightings as usize).min(self.sighting.len())]
    }

    /// The obstacles that are valid: centre and half extents, m.
    pub fn obstacles(&self) -> &[[f64; 6]] {
        &self.obstacle[..(self.obstacles as usize).min(self.obstacle.len())]
    }
}

/// How far along the line from `eye` to `place` something long and round, as thick as `radius` around the line between two points, is met, as a
/// fraction of it; `None` if it is not. Exact where both cross at a right angle. What is not finite is met nowhere.
pub fn limb_before(limb: [[f64; 3]; 2], radius: f64, eye: [f64; 3], place: [f64; 3]) -> Option<f64> {
    let Nearest { apart, along_sight, length } = nearest(limb, [eye, place]);
    (apart < radius).then(|| (along_sight - (radius * radius - apart * apart).sqrt() / length).max(0.0))
}

/// Where a line of sight comes nearest to a limb.
struct Nearest {
    /// Their distance there, m.
    apart: f64,
    /// How far along the line of sight that is, as a fraction of it.
    along_sight: f64,
    /// How long the line of sight is, m.
    length: f64,
}

/// Where two line segments are nearest to each other (Ericson 2005, 5.1.9); NaN where a number is none.
fn nearest([from, to]: [[f64; 3]; 2], [eye, place]: [[f64; 3]; 2]) -> Nearest {
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
    Nearest { apart: dot(apart, apart).sqrt(), along_sight, length: e.sqrt() }
}

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
    fn a_limb_hides_what_lies_behind_it_and_nothing_beside_or_before_it() {
        let forearm = [[-0.2, 0.0, 1.3], [0.0, 0.0, 1.1]];
        let hidden = |place| limb_before(forearm, 0.04, EYE, place).is_some();
        assert!(hidden([-1.0, 0.0, 1.15]) && hidden([-0.1, 0.0, 1.2]), "behind, and within");
        assert!(!hidden([0.5, 0.0, 1.1]), "before it");
        assert!(!hidden([-1.0, 0.2, 1.15]) && !hidden([-1.0, 0.0, 0.9]), "beside and below it");
        assert!(!hidden([f64::NAN, 0.0, 1.15]));
        let nothing = [[0.0, 0.0, 1.0]; 2];
        let met = limb_before(nothing, 0.04, EYE, [-1.0, 0.0, 1.0]).unwrap_or(f64::NAN);
        assert!((met - 1.96 / 3.0).abs() < 1e-9, "as thick as it is long, and met at its surface: {met}");
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
            let found = super::nearest(limb, sight).apart;
            assert!(found <= nearest + 1e-9 && nearest < found + 0.02, "{seed}: {found}, {nearest}");
        }
    }

    #[test]
    fn a_margin_hides_more_and_numbers_that_are_none_hide_nothing() {
        let beside = [0.0, 0.215, 1.0];
        let hidden = |one: &[f64; 6], place, margin| box_before(one, EYE, place, margin).is_some();
        assert!(!hidden(&BOX, beside, 0.0) && hidden(&BOX, beside, 0.02));
        assert!(!hidden(&[f64::NAN; 6], [3.0, 0.0, 1.0], 0.0));
        let mut view: Box<SceneView> = bytemuck::zeroed_box();
        view.obstacle[0] = BOX;
        assert!(view.obstacles().is_empty(), "none is valid");
        view.obstacles = u32::MAX;
        assert_eq!(view.obstacles().len(), view.obstacle.len());
    }
}
