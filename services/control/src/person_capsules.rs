use coact_messages::{HandPercept, HandView, KeypointName};
use coact_motion::Capsule;
use coact_safety::PersonLimits;
use nalgebra::{Point3, Vector3};

/// Upper arm, forearm and hand of the person, and what the hand holds, as bounding capsules; and how fast the hand moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PersonCapsules {
    limbs: [Capsule; 3],
    /// What is in the hand: index of its sighting, and a capsule around it.
    held: Option<(usize, Capsule)>,
    velocity: Vector3<f64>,
    /// For how long the hand is taken to go on as it moves, s.
    extrapolated: f64,
}

/// Keypoints below this confidence are not believed.
const BELIEF: f64 = 0.2;

impl PersonCapsules {
    /// Most capsules that there are of a person: three limbs, and what the hand holds.
    pub const MOST: usize = 4;

    /// From perception's estimate of the wrist and the tracker's newest frame; none when the hand is not tracked.
    pub fn of(hand: &HandPercept, view: &HandView, limits: &PersonLimits) -> Option<Self> {
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
        let tip = seen(KeypointName::MiddleTip).map_or(wrist + limits.hand_length * along, |tip| tip + shift);
        let joints = [shoulder, elbow, wrist, tip];
        let limb = |index: usize| Capsule {
            start: joints[index],
            end: joints[index + 1],
            radius: limits.radii[index],
        };
        let extrapolated = limits.extrapolated.as_secs_f64();
        Some(Self { limbs: std::array::from_fn(limb), held: None, velocity, extrapolated })
    }

    /// The same with whichever of these parts is nearest to the hand in it, if it is nearer than `within` m. Each part: index
    /// of its sighting, and a capsule around where it was seen `ago` s before now.
    pub fn holding(mut self, seen: impl Iterator<Item = (usize, Capsule)>, ago: f64, within: f64) -> Self {
        let way = self.way(ago);
        let [.., hand] = self.limbs;
        let parts = seen.map(|(index, part)| (index, moved(&part, &way)));
        let gaps = parts.map(|(index, part)| (hand.distance(&part), (index, part)));
        let nearest = gaps.filter(|(gap, _)| *gap < within).min_by(|one, other| one.0.total_cmp(&other.0));
        self.held = nearest.map(|(_, part)| part);
        self
    }

    /// Index of the sighting of what is in the hand.
    pub fn held(&self) -> Option<usize> {
        self.held.map(|(index, _)| index)
    }

    /// Upper arm, forearm, hand and what it holds `ahead` s from now. The elbow moves half as far as the hand, the shoulder
    /// stays.
    pub fn after(&self, ahead: f64) -> impl Iterator<Item = Capsule> + use<> {
        let way = self.way(ahead);
        let [upper, fore, hand] = self.limbs;
        let arm = [
            Capsule { end: upper.end + 0.5 * way, ..upper },
            Capsule { start: fore.start + 0.5 * way, end: fore.end + way, ..fore },
            moved(&hand, &way),
        ];
        arm.into_iter().chain(self.held.map(|(_, part)| moved(&part, &way)))
    }

    fn way(&self, time: f64) -> Vector3<f64> {
        self.velocity * time.min(self.extrapolated)
    }
}

fn moved(capsule: &Capsule, way: &Vector3<f64>) -> Capsule {
    Capsule { start: capsule.start + way, end: capsule.end + way, ..*capsule }
}
