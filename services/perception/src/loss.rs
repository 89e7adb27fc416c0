use crate::evidence::follow;
use crate::objects::{Hands, PartTracks, TOUCH, TaskPlaces};
use crate::plausible_cycle::cycle;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{JointReading, MAX_PARTS, Percept};
use coact_period::cycles;
use coact_stage_state::{Flag, Implausible, Slot, ensure};
use std::time::Duration;

/// Fingers that stand this much further open than when they held the part have let go of it, rad: more than they give way
/// under load, less than any deliberate opening. Chosen by hand.
const OPENED: f64 = 0.02;
/// Distance of a part from the axis of the robot's hand beyond which it is not in the hand any more, m: the length of a
/// finger. Chosen by hand.
const AWAY: f64 = 0.08;
/// How long after the loss of touch a part must be unseen, or lie on the table, to be lost: seven frames of the recogniser,
/// which misses single ones.
const MISSED: u64 = cycles(Duration::from_millis(250));
/// How long the suspicion lasts: what fell has come to lie by then. What was let go in mid-air is suspected until it is seen. Chosen by hand.
const SUSPECTED: u64 = cycles(Duration::from_secs(1));
/// How long a loss is told: until the robot has decided what to do about it. Chosen by hand.
const TOLD: u64 = cycles(Duration::from_secs(3));
/// Time in which the evidence of a loss rises or falls from end to end, cycles.
const RAMP: f64 = cycles(Duration::from_millis(60)) as f64;

/// What becomes of the part in the robot's hand when the fingers do not feel it any more.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct Loss {
    /// Track of the held part.
    held: Slot,
    /// Its kind.
    kind: u64,
    /// How far the fingers were closed on it, rad.
    grip: f64,
    /// Cycle at which touch was lost though the fingers were not opened, or were opened in mid-air; 0: it was not.
    suspected: u64,
    /// Whether they were opened. Then the part is lost only if it is seen to have fallen: another hand may have it.
    opened: Flag,
    /// Cycle up to which a loss is told.
    told: u64,
    /// The kind that was lost.
    lost: u64,
}

impl Loss {
    /// One cycle of proprioception.
    pub fn feel(&mut self, tick: u64, joints: &JointReading, parts: &PartTracks, places: &TaskPlaces) {
        let closure = coact_messages::finger_closure(&joints.position);
        if joints.touch > TOUCH {
            self.suspected = 0;
            if let Some((track, kind)) = parts.with_the_robot() {
                let same = self.held.get() == Some(track);
                self.grip = if same { self.grip.max(closure) } else { closure };
                (self.held, self.kind) = (Slot::of(track), kind as u64);
                self.told = if self.lost == self.kind { 0 } else { self.told };
            }
        } else if let Some(track) = self.held.get()
            && self.suspected == 0
        {
            let opened = closure <= self.grip - OPENED || closure.is_nan();
            let kind = self.kind as usize;
            let part = parts.track(track).filter(|part| part.kind() == Some(kind));
            let put_down = opened && !part.is_some_and(|part| places.is_airborne(kind, part.position));
            self.opened = opened.into();
            self.suspected = tick.max(1);
            if put_down {
                self.forget();
            }
        } else if !self.opened.is_set() && self.suspected > 0 && tick > self.suspected + SUSPECTED {
            self.forget();
        }
    }

    /// One frame of sight: a part that went out of the closed fingers and is seen elsewhere, or nowhere, is lost; and so is
    /// one that lies below the hand, or that fingers let go in mid-air and that is seen to have fallen.
    pub fn look(&mut self, parts: &PartTracks, around: &Hands, places: &TaskPlaces) {
        let Some(track) = self.held.get().filter(|_| self.suspected > 0) else { return };
        let seen = parts.track(track).filter(|part| part.kind() == Some(self.kind as usize));
        let after = |cycle: u64| cycle > self.suspected;
        let missed = parts.captured > self.suspected + MISSED;
        let lost = match seen {
            Some(part) if part.is_held() || places.is_mounted(self.kind as usize, part.position) => {
                self.forget();
                return;
            }
            _ if self.opened.is_set() => self.has_fallen(parts, places),
            Some(part) if after(part.seen) => {
                let size = places.size(self.kind as usize);
                let lies = !places.is_airborne(self.kind as usize, part.position);
                let away = |axis| part.distance_to_hand(size, axis) > AWAY || lies && missed;
                around.hand_axis.map_or(lies, away)
            }
            _ => missed,
        };
        if lost {
            (self.told, self.lost) = (parts.captured + TOLD, self.kind);
            self.forget();
        }
    }

    /// No part is held, and none is missed.
    fn forget(&mut self) {
        (self.held, self.suspected) = (Slot::EMPTY, 0);
    }

    /// Whether the kinds of part that it is about are among so many `kinds`.
    pub fn is_about(&self, kinds: usize) -> bool {
        self.kind < kinds as u64 && self.lost < kinds as u64
    }

    /// Refuses what is no state of it.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.held.is_below(MAX_PARTS), "loss.held", "a track of a part")?;
        cycle("loss.suspected", self.suspected)?;
        cycle("loss.told", self.told)
    }

    /// Whether a part of the kind lies where it has not lain since before the suspicion: on the table, in no hand.
    fn has_fallen(&self, parts: &PartTracks, places: &TaskPlaces) -> bool {
        let since = parts.captured.saturating_sub(self.suspected);
        parts.parts().any(|(kind, part)| {
            let free = !part.is_held() && !places.is_mounted(kind, part.position);
            let lies = free && !places.is_airborne(kind, part.position);
            kind == self.kind as usize && lies && part.seen > self.suspected && u64::from(part.still) < since
        })
    }

    /// Moves the evidence of lost parts one cycle on.
    pub fn report(&self, tick: u64, kinds: usize, out: &mut Percept) {
        for (kind, evidence) in out.lost.iter_mut().enumerate().take(kinds) {
            let told = tick < self.told && self.lost == kind as u64;
            follow(evidence, f64::from(u8::from(told)), RAMP);
        }
    }
}
