use coact_motion::Capsule;
use coact_person::box_before;

/// Divisors are no less than this, m²: lines that are shorter are points.
const LEAST: f64 = 1e-12;

/// What stands between the robot's eye and what it looks at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinesOfSight<'a> {
    /// Where the eye is, m.
    pub eye: [f64; 3],
    /// What stands on the table beside the parts: centre and half extents, m.
    pub boxes: &'a [[f64; 6]],
    /// The robot's own links.
    pub robot: &'a [Capsule],
    /// The person's arm.
    pub person: &'a [Capsule],
}

impl LinesOfSight<'_> {
    /// Whether something stands before `place`.
    pub fn hide(&self, place: [f64; 3]) -> bool {
        let by_box = |own: &[f64; 6]| box_before(own, self.eye, place, 0.0).is_some();
        self.boxes.iter().any(by_box) || self.limbs().any(|limb| self.met(limb, place).is_some())
    }

    /// How far along the line of sight to `place` a limb is met, as a fraction of it.
    pub fn met(&self, limb: &Capsule, place: [f64; 3]) -> Option<f64> {
        limb_before([limb.start.into(), limb.end.into()], limb.radius, self.eye, place)
    }

    /// Arms: the robot's and the person's.
    pub fn limbs(&self) -> impl Iterator<Item = &Capsule> {
        self.robot.iter().chain(self.person)
    }
}

/// How far along the line from `eye` to `place` something long and round, as thick as `radius` around the line between two points, is met, as a
/// fraction of it; `None` if it is not. Exact where both cross at a right angle. What is not finite is met nowhere.
fn limb_before(limb: [[f64; 3]; 2], radius: f64, eye: [f64; 3], place: [f64; 3]) -> Option<f64> {
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
    let (a, e, f) = (dot(limb, limb), dot(sight, sight).max(LEAST), dot(sight, between));
    let (b, c) = (dot(limb, sight), dot(limb, between));
    let denominator = a * e - b * b;
    let nearest = if denominator > LEAST { ((b * f - c * e) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let along_sight = ((b * nearest + f) / e).clamp(0.0, 1.0);
    let along_limb = ((b * along_sight - c) / a.max(LEAST)).clamp(0.0, 1.0);
    let apart = [0, 1, 2].map(|axis| between[axis] + along_limb * limb[axis] - along_sight * sight[axis]);
    Nearest { apart: dot(apart, apart).sqrt(), along_sight, length: e.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EYE: [f64; 3] = [2.0, 0.0, 1.0];

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
}
