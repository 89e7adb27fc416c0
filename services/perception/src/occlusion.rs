use crate::hand::{BELIEVED, TrackedHand, USABLE};
use crate::objects::TaskPlaces;
use crate::plausible_cycle::cycle;
use bytemuck::{Pod, Zeroable};
use coact_messages::{HandView, KeypointName, SceneView};
use coact_period::cycles;
use coact_stage_state::Implausible;
use nalgebra::Vector3;
use std::time::Duration;

/// Age of the newest frame from which the hand is out of sight: three frames at 60 Hz, more than one that was dropped
/// takes.
const OUT_OF_SIGHT: u64 = cycles(Duration::from_millis(60));
/// Age beyond which the hand's disappearance is no longer news: the frame tells nothing of where the hand is now.
const LATE: u64 = USABLE;
/// How far ahead of the last sight the hand's way is followed, s: half a reach, which takes 0.35 to 0.9 s.
const AHEAD: f64 = 0.3;
/// In how many steps. Chosen by hand: at 1 m/s they are 5 cm long, and occluders are larger.
const STEPS: usize = 6;
/// How near to where it lay the wrist of a hand is that still lies there, m: the tracker's scatter, and a sway. Chosen by hand.
const LIES: f64 = 0.03;
/// How long a hand may stay hidden. Chosen by hand: longer than a grasp behind an occluder takes, not so long that a person
/// who has gone keeps the robot waiting.
const LONGEST: u64 = cycles(Duration::from_secs(4));

/// A reach that has gone out of sight behind something.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Occlusion {
    /// Cycle since which the hand has been hidden; 0: it is not.
    since: u64,
    /// Capture of the frame after which it went out of sight.
    last_seen: u64,
}

impl Occlusion {
    pub fn is_hidden(&self) -> bool {
        self.since > 0
    }

    /// Refuses what is no state of it.
    pub fn check(&self) -> Result<(), Implausible> {
        cycle("occlusion.since", self.since)
    }

    /// One cycle: a hand that `may_reach`, that is not seen any more, and that was led behind an occluder, is hidden until it is seen again.
    pub fn watch(
        &mut self,
        tick: u64,
        (view, seen): (&SceneView, &HandView),
        hand: &TrackedHand,
        may_reach: bool,
        places: &TaskPlaces,
    ) {
        if self.since > 0 {
            let over = hand.captured != self.last_seen || tick > self.since + LONGEST;
            self.since = if over { 0 } else { self.since };
            return;
        }
        let vanished = may_reach && has_vanished(tick, hand, seen) && hand.captured != self.last_seen;
        if vanished && leads_behind(view, hand, places) {
            (self.since, self.last_seen) = (tick.max(1), hand.captured);
        }
    }
}

/// Whether the hand has just gone out of sight. One whose wrist is `seen` where it lay still has not: only its fingers have, behind something.
pub(crate) fn has_vanished(tick: u64, hand: &TrackedHand, seen: &HandView) -> bool {
    let wrist = &seen.keypoints[KeypointName::Wrist as usize];
    let moved = Vector3::from(wrist.position) - Vector3::from(hand.movement.place_of_stillness());
    let is_new = tick.saturating_sub(seen.captured_cycle) < OUT_OF_SIGHT;
    let lies = is_new && wrist.confidence > BELIEVED && moved.norm() < LIES;
    !lies && (OUT_OF_SIGHT..LATE).contains(&hand.age(tick))
}

/// Whether the hand's way led out of the robot's sight.
pub(crate) fn leads_behind(view: &SceneView, hand: &TrackedHand, places: &TaskPlaces) -> bool {
    let sight = places.sight(view);
    let way = hand.velocity() * (AHEAD / STEPS as f64);
    let starts = [hand.centre(), hand.shape().wrist.into()];
    starts.iter().any(|start| (0..=STEPS).any(|step| sight.hides_hand((start + way * step as f64).into())))
}
