use crate::hand::HandMemory;
use crate::objects::Places;
use crate::preshape::ReachRecord;
use bytemuck::{Pod, Zeroable};
use coact_messages::SensorSample;

/// Age of the newest frame from which the hand is out of sight, cycles: more than one dropped frame takes.
const OUT_OF_SIGHT: u64 = 60;
/// Age beyond which the hand's disappearance is no longer news, cycles.
const LATE: u64 = 150;
/// How far ahead of the last sight the hand's way is followed, s, and in how many steps.
const AHEAD: f64 = 0.3;
const STEPS: usize = 6;
/// How long a hand may stay hidden, cycles.
const LONGEST: u64 = 4000;

/// A reach that has gone out of sight behind something.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Hiding {
    /// Cycle since which the hand has been hidden; 0: it is not.
    since: u64,
    /// Capture of the frame after which it went out of sight.
    last_seen: u64,
}

impl Hiding {
    pub fn is_hidden(&self) -> bool {
        self.since > 0
    }

    /// One cycle: a reach that is not seen any more, and that led behind an occluder, is hidden until it is seen again.
    pub fn watch(
        &mut self,
        tick: u64,
        sample: &SensorSample,
        hand: &HandMemory,
        reach: &ReachRecord,
        places: &Places,
    ) {
        let age = hand.age(tick);
        if self.since > 0 {
            let over = hand.captured != self.last_seen || tick > self.since + LONGEST;
            self.since = if over { 0 } else { self.since };
            return;
        }
        let reaches = hand.motion.is_moving() && reach.onset > 0 && hand.motion.onset == reach.onset;
        let vanished = reaches && (OUT_OF_SIGHT..LATE).contains(&age) && hand.captured != self.last_seen;
        if vanished && leads_behind(sample, hand, places) {
            (self.since, self.last_seen) = (tick.max(1), hand.captured);
        }
    }
}

/// Whether the hand's way led out of the robot's sight.
fn leads_behind(sample: &SensorSample, hand: &HandMemory, places: &Places) -> bool {
    let way = hand.velocity() * (AHEAD / STEPS as f64);
    let starts = [hand.centre(), hand.shape().wrist.into()];
    starts.iter().any(|start| {
        (0..=STEPS).any(|step| places.is_hidden((start + way * step as f64).into(), &sample.scene))
    })
}
