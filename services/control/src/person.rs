use coact_messages::{HandPercept, HandView, KeypointName};
use coact_motion::Capsule;
use nalgebra::{Point3, Vector3};

/// Upper arm, forearm and hand of the person, and what the hand holds, as capsules; and how fast the hand moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PersonArm {
    capsules: [Capsule; 3],
    /// What is in the hand: index of its sighting, and a capsule around it.
    part: Option<(usize, Capsule)>,
    velocity: Vector3<f64>,
}

/// Keypoints below this confidence are not believed.
const BELIEF: f64 = 0.2;
/// A part that the person is believed to hold is not farther from the hand than this, m.
const IN_HAND: f64 = 0.03;
/// For how long a hand is thought to go on as it moves, s.
const GOES_ON: f64 = 0.3;

impl PersonArm {
    /// Radii of upper arm, forearm and hand, m.
    pub const RADII: [f64; 3] = [0.06, 0.05, 0.045];
    /// Most capsules that there are of a person: these, and what the hand holds.
    pub const CAPSULES: usize = Self::RADII.len() + 1;
    /// Length of a hand of which only the wrist is known, m.
    pub const HAND: f64 = 0.18;

    /// From perception's estimate of the wrist and the tracker's newest frame; none when the hand is not tracked.
    pub fn of(hand: &HandPercept, view: &HandView) -> Option<Self> {
        let wrist = Point3::from(hand.wrist);
        let velocity = Vector3::from(hand.velocity);
        if hand.tracked != 1 || !wrist.iter().chain(velocity.iter()).all(|value| value.is_finite()) {
            return None;
        }
        let seen = |name: KeypointName| {
            let point = view.keypoints[name as usize];
            let believed = point.confidence > BELIEF && point.position.iter().all(|value| value.is_finite());
            believed.then(|| Point3::from(point.position))
        };
        // The tracker's frame is some cycles old: the arm is moved to where the wrist is now.
        let shift = seen(KeypointName::Wrist).map_or_else(Vector3::zeros, |old| wrist - old);
        let elbow = seen(KeypointName::Elbow).map_or(wrist, |elbow| elbow + 0.5 * shift);
        let shoulder = seen(KeypointName::Shoulder).unwrap_or(elbow);
        let along = (wrist - elbow).try_normalize(1e-6).unwrap_or_else(Vector3::zeros);
        let tip = seen(KeypointName::MiddleTip).map_or(wrist + Self::HAND * along, |tip| tip + shift);
        let joints = [shoulder, elbow, wrist, tip];
        let capsule = |index: usize| Capsule {
            start: joints[index],
            end: joints[index + 1],
            radius: Self::RADII[index],
        };
        Some(Self { capsules: std::array::from_fn(capsule), part: None, velocity })
    }

    /// The same with whichever of these is nearest to the hand in it, if one is near enough: capsules around what was seen
    /// `ago` s before now, each with the index of its sighting.
    pub fn holding(mut self, seen: impl Iterator<Item = (usize, Capsule)>, ago: f64) -> Self {
        let way = self.velocity * ago.min(GOES_ON);
        let [.., hand] = self.capsules;
        let parts = seen.map(|(index, part)| (index, moved(&part, &way)));
        let gaps = parts.map(|(index, part)| (hand.distance(&part), (index, part)));
        let nearest = gaps.filter(|(gap, _)| *gap < IN_HAND).min_by(|one, other| one.0.total_cmp(&other.0));
        self.part = nearest.map(|(_, part)| part);
        self
    }

    /// Index of the sighting of what is in the hand.
    pub fn held(&self) -> Option<usize> {
        self.part.map(|(index, _)| index)
    }

    /// Upper arm, forearm, hand and what it holds `ahead` s from now.
    pub fn after(&self, ahead: f64) -> impl Iterator<Item = Capsule> + use<> {
        let way = self.velocity * ahead.min(GOES_ON);
        let [upper, fore, hand] = self.capsules;
        let arm = [
            Capsule { end: upper.end + 0.5 * way, ..upper },
            Capsule { start: fore.start + 0.5 * way, end: fore.end + way, ..fore },
            moved(&hand, &way),
        ];
        arm.into_iter().chain(self.part.map(|(_, part)| moved(&part, &way)))
    }
}

fn moved(capsule: &Capsule, way: &Vector3<f64>) -> Capsule {
    Capsule { start: capsule.start + way, end: capsule.end + way, ..*capsule }
}
