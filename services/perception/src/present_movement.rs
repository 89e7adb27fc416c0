use crate::heading::Heading;
use crate::perception_state::PerceptionState;
use crate::preshape::Classifier;

/// Phase of a reach beyond which it is over, whatever came of it: contact comes at about 1.8, and people vary by 10 %.
const OVER: f64 = 2.3;

/// What the hand is doing now.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PresentMovement {
    /// Where it goes.
    pub heading: Heading,
    /// Phase of a reach from rest (see [`crate::SNAPSHOTS`]); `None` for any other movement.
    pub phase: Option<f64>,
}

impl PresentMovement {
    /// The present movement; `None` when the hand is still or not tracked.
    pub fn now(tick: u64, state: &PerceptionState, classifier: &Classifier) -> Option<Self> {
        let (hand, reach) = (&state.hand, &state.preshape.reach);
        if !hand.is_tracked(tick) {
            return None;
        }
        let from_rest = reach.is_of(&hand.movement);
        let phase = classifier.phase(&state.preshape, tick);
        let phase = (from_rest && phase < OVER).then_some(phase);
        let (centre, velocity) = hand.steady_centre();
        let heading = Heading { centre, velocity };
        (phase.is_some() || hand.movement.is_moving()).then_some(Self { heading, phase })
    }
}
