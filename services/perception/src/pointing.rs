use crate::evidence::smooth_step;
use crate::objects::{PartTrack, TaskPlaces};
use crate::perception_state::PerceptionState;
use coact_joint_task::Agent;
use coact_messages::Percept;
use nalgebra::Vector3;

/// By how much the index finger of a pointing hand is longer than the middle one, from the wrist, m: no, and full evidence. Chosen by
/// hand: fingers that grasp or rest are about as long as each other, folded ones some 9 cm shorter.
const LONGER: (f64, f64) = (0.02, 0.05);
/// Speed of a hand that points, m/s: full, and no evidence. Chosen by hand: a hand that passes by is faster.
const STILL: (f64, f64) = (0.10, 0.35);
/// Angle between the finger and the line to what it points at, rad. Chosen by hand: three and a half degrees, of the person and of the tracker.
const SCATTER: f64 = 0.06;
/// The angle within which something is pointed at for certain, and beyond which nothing is, rad. Chosen by hand.
const MEANT: (f64, f64) = (0.18, 0.35);

/// Where the index finger of a hand points that shows something with it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pointing {
    /// Finger tip, m.
    from: Vector3<f64>,
    /// Unit vector along the finger.
    along: Vector3<f64>,
    /// How surely the hand points, in [0, 1].
    evidence: f64,
}

impl Pointing {
    /// What the hand shows now; `None` when it does not point.
    pub fn now(tick: u64, state: &PerceptionState, out: &Percept) -> Option<Self> {
        let hand = &state.hand;
        let (from, along) = hand.index_finger().filter(|_| hand.is_tracked(tick))?;
        let longer = smooth_step(hand.index_beyond_middle(), LONGER.0, LONGER.1);
        let still = smooth_step(hand.velocity().norm(), STILL.1, STILL.0);
        let empty = 1.0 - out.person_holds.iter().copied().fold(0.0, f64::max);
        let evidence = longer * still * empty;
        (evidence > 0.0).then_some(Self { from, along, evidence })
    }

    /// Evidence in [0, 1] that it points at a part of `kind` that `owner` has, in the hand or in the workspace: how near to the finger's
    /// line that kind's parts are, among all that are there.
    pub fn at(&self, kind: usize, owner: Agent, state: &PerceptionState, places: &TaskPlaces) -> f64 {
        let is_there = |(kind, part): &(usize, &PartTrack)| {
            let in_hand = owner == Agent::Robot && part.is_with_the_robot();
            in_hand || places.is_free_at(owner.index(), *kind, part)
        };
        let (mut own, mut all, mut nearest) = (0.0, 0.0, f64::INFINITY);
        for (other, part) in state.parts.parts().filter(is_there) {
            let miss = self.miss(part.centre(places.size(other)));
            let nearness = (-0.5 * (miss / SCATTER).powi(2)).exp();
            all += nearness;
            if other == kind {
                own += nearness;
                nearest = f64::min(nearest, miss);
            }
        }
        if own == 0.0 {
            return 0.0;
        }
        self.evidence * smooth_step(nearest, MEANT.1, MEANT.0) * own / all
    }

    /// Angle between the finger and the line to a place, rad.
    fn miss(&self, place: Vector3<f64>) -> f64 {
        (place - self.from).angle(&self.along)
    }
}
