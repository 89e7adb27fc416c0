use coact_messages::{HandPercept, HandView, KeypointName};
use coact_motion::Capsule;
use nalgebra::{Point3, Vector3};

/// Upper arm, forearm and hand of the person as capsules, and how fast the hand moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PersonArm {
    capsules: [Capsule; 3],
    velocity: Vector3<f64>,
}

/// Radii of upper arm, forearm and hand, m.
const RADII: [f64; 3] = [0.06, 0.05, 0.045];
/// Length of a hand of which only the wrist is known, m.
const HAND: f64 = 0.18;
/// Keypoints below this confidence are not believed.
const BELIEF: f64 = 0.2;
/// For how long a hand is thought to go on as it moves, s.
const GOES_ON: f64 = 0.3;

impl PersonArm {
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
        let tip = seen(KeypointName::MiddleTip).map_or(wrist + HAND * along, |tip| tip + shift);
        let joints = [shoulder, elbow, wrist, tip];
        let capsule =
            |index: usize| Capsule { start: joints[index], end: joints[index + 1], radius: RADII[index] };
        Some(Self { capsules: std::array::from_fn(capsule), velocity })
    }

    /// Upper arm, forearm and hand `ahead` s from now.
    pub fn after(&self, ahead: f64) -> [Capsule; 3] {
        let way = self.velocity * ahead.min(GOES_ON);
        let [upper, fore, hand] = self.capsules;
        [
            Capsule { end: upper.end + 0.5 * way, ..upper },
            Capsule { start: fore.start + 0.5 * way, end: fore.end + way, ..fore },
            Capsule { start: hand.start + way, end: hand.end + way, ..hand },
        ]
    }
}
