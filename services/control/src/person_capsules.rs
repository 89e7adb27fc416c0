use coact_messages::PersonArm;
use coact_motion::Capsule;
use coact_safety::PersonLimits;
use nalgebra::{Point3, Vector3};

/// Upper arm, forearm and hand of the person, and what the hand holds, as bounding capsules; and how they move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PersonCapsules {
    limbs: [MovingCapsule; 3],
    /// What is in the hand: index of its sighting, and a capsule around it.
    held: Option<(usize, MovingCapsule)>,
    /// For how long all that is taken to go on as it moves, s.
    extrapolated: f64,
}

/// A capsule whose ends move, m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
struct MovingCapsule {
    now: Capsule,
    velocities: [Vector3<f64>; 2],
}

/// Shorter than this, a forearm has no direction, m.
const SHORTEST: f64 = 1e-6;

impl PersonCapsules {
    /// Most capsules that there are of a person: three limbs, and what the hand holds.
    pub const MOST: usize = 4;

    /// Around the arm that perception has estimated; none when its numbers are not finite. A hand whose end was never seen goes on
    /// along the forearm.
    pub fn of(arm: &PersonArm, limits: &PersonLimits) -> Option<Self> {
        let points = arm.points();
        let mut numbers = points.iter().flat_map(|point| point.position.iter().chain(&point.velocity));
        if !numbers.all(|number| number.is_finite()) {
            return None;
        }
        let mut positions = points.map(|point| Point3::from(point.position));
        let velocities = points.map(|point| Vector3::from(point.velocity));
        let [_, elbow, wrist, tip] = &mut positions;
        if !arm.fingertip.deviation.is_finite() {
            let along = (*wrist - *elbow).try_normalize(SHORTEST).unwrap_or_else(Vector3::zeros);
            *tip = *wrist + limits.hand_length * along;
        }
        let limb = |index: usize| MovingCapsule {
            now: Capsule { start: positions[index], end: positions[index + 1], radius: limits.radii[index] },
            velocities: [velocities[index], velocities[index + 1]],
        };
        let extrapolated = limits.extrapolated.as_secs_f64();
        Some(Self { limbs: std::array::from_fn(limb), held: None, extrapolated })
    }

    /// The same with whichever of these parts is nearest to the hand in it, if it is nearer than `within` m. Each part: index
    /// of its sighting, and a capsule around where it was seen `ago` s before now. It moves along with the wrist.
    pub fn holding(mut self, seen: impl Iterator<Item = (usize, Capsule)>, ago: f64, within: f64) -> Self {
        let [.., hand] = self.limbs;
        let [wrist, _] = hand.velocities;
        let parts = seen.map(|(index, part)| {
            let then = MovingCapsule { now: part, velocities: [wrist; 2] };
            let now = then.after(ago.min(self.extrapolated));
            (index, MovingCapsule { now, ..then })
        });
        let gaps = parts.map(|(index, part)| (hand.now.distance(&part.now), (index, part)));
        let nearest = gaps.filter(|(gap, _)| *gap < within).min_by(|one, other| one.0.total_cmp(&other.0));
        self.held = nearest.map(|(_, part)| part);
        self
    }

    /// Index of the sighting of what is in the hand.
    pub fn held(&self) -> Option<usize> {
        self.held.map(|(index, _)| index)
    }

    /// Upper arm, forearm, hand and what it holds `ahead` s from now.
    pub fn after(&self, ahead: f64) -> impl Iterator<Item = Capsule> + use<> {
        let time = ahead.min(self.extrapolated);
        let held = self.held.map(|(_, part)| part);
        self.limbs.into_iter().chain(held).map(move |capsule| capsule.after(time))
    }
}

impl MovingCapsule {
    fn after(&self, time: f64) -> Capsule {
        let [start, end] = self.velocities;
        Capsule { start: self.now.start + start * time, end: self.now.end + end * time, ..self.now }
    }
}
