use crate::memory::Memory;
use crate::preshape::Classifier;
use crate::targets::Heading;

/// Phase of a reach beyond which it is over, whatever came of it.
const OVER: f64 = 2.3;

/// What the hand is doing now.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Movement {
    /// Where it goes.
    pub heading: Heading,
    /// Phase of a reach from rest (see [`crate::SNAPSHOTS`]); `None` for any other movement.
    pub phase: Option<f64>,
}

impl Movement {
    /// The present movement; `None` when the hand is still or not tracked.
    pub fn now(tick: u64, memory: &Memory, classifier: &Classifier) -> Option<Self> {
        let (hand, reach) = (&memory.hand, &memory.preshape.reach);
        if !hand.is_tracked(tick) {
            return None;
        }
        let from_rest = reach.onset > 0 && hand.motion.onset == reach.onset;
        let phase = classifier.phase(&memory.preshape, tick);
        let phase = (from_rest && phase < OVER).then_some(phase);
        let heading = Heading { centre: hand.centre(), velocity: hand.centre_velocity() };
        (phase.is_some() || hand.motion.is_moving()).then_some(Self { heading, phase })
    }
}
