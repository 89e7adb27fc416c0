use crate::evidence::follow;
use crate::objects::{ObjectsMemory, Places, Surroundings, TOUCH};
use bytemuck::{Pod, Zeroable};
use coact_messages::{JointReading, Percept};

/// Fingers that stand this much further open than when they held the part have let go of it, rad.
const OPENED: f64 = 0.02;
/// Distance of a part from the robot's grasp point beyond which it is not in the hand any more, m.
const AWAY: f64 = 0.08;
/// How long after the loss of touch a part must be unseen to be lost, and how long the suspicion lasts, cycles.
const UNSEEN: u64 = 250;
const SUSPECTED: u64 = 1000;
/// How long a loss is told, cycles, and the time in which its evidence rises or falls from end to end.
const TOLD: u64 = 3000;
const RAMP: f64 = 60.0;

/// What becomes of the part in the robot's hand when the fingers do not feel it any more.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Loss {
    /// Index of the held part's track plus one; 0: none is held.
    held: u64,
    /// Its kind.
    kind: u64,
    /// How far the fingers were closed on it, rad.
    grip: f64,
    /// Cycle at which touch was lost though the fingers were not opened, or were opened in mid-air; 0: it was not.
    suspected: u64,
    /// 1: they were opened. Then the part is lost only if it is seen to have fallen: another hand may have it.
    opened: u64,
    /// Cycle up to which a loss is told, and the kind that was lost.
    told: u64,
    lost: u64,
}

impl Loss {
    /// One cycle of proprioception.
    pub fn feel(&mut self, tick: u64, joints: &JointReading, objects: &ObjectsMemory, places: &Places) {
        let closing = coact_messages::finger_closure(&joints.position);
        if joints.touch > TOUCH {
            self.suspected = 0;
            if let Some((track, kind)) = objects.with_the_robot() {
                let same = self.held == track as u64 + 1;
                self.grip = if same { self.grip.max(closing) } else { closing };
                (self.held, self.kind) = (track as u64 + 1, kind as u64);
                self.told = if self.lost == self.kind { 0 } else { self.told };
            }
        } else if self.held > 0 && self.suspected == 0 {
            let opened = closing <= self.grip - OPENED || closing.is_nan();
            let kind = self.kind as usize;
            let part = objects.track(self.held as usize - 1).filter(|part| part.kind() == Some(kind));
            let put_down = opened && !part.is_some_and(|part| places.is_airborne(kind, part.position));
            self.opened = u64::from(opened);
            (self.held, self.suspected) = if put_down { (0, 0) } else { (self.held, tick.max(1)) };
        } else if self.suspected > 0 && tick > self.suspected + SUSPECTED {
            (self.held, self.suspected) = (0, 0);
        }
    }

    /// One frame of sight: a part that went out of the closed fingers and is seen elsewhere, or nowhere, is lost; and so is
    /// one that fingers let go in mid-air and that is seen to have fallen.
    pub fn look(&mut self, objects: &ObjectsMemory, around: &Surroundings, places: &Places) {
        let Some(track) = self.held.checked_sub(1).filter(|_| self.suspected > 0) else { return };
        let seen = objects.track(track as usize).filter(|part| part.kind() == Some(self.kind as usize));
        let after = |cycle: u64| cycle > self.suspected;
        let lost = match seen {
            Some(part) if part.is_held() || places.is_mounted(self.kind as usize, part.position) => {
                (self.held, self.suspected) = (0, 0);
                return;
            }
            _ if self.opened == 1 => self.has_fallen(objects, places),
            Some(part) if after(part.seen) => {
                let body = places.body(self.kind as usize);
                let away = |axis| part.distance_to_hand(body, axis) > AWAY;
                around.hand_axis.map_or(!places.is_airborne(self.kind as usize, part.position), away)
            }
            _ => objects.captured > self.suspected + UNSEEN,
        };
        if lost {
            (self.told, self.lost) = (objects.captured + TOLD, self.kind);
            (self.held, self.suspected) = (0, 0);
        }
    }

    /// Whether a part of the kind lies where it has not lain since before the suspicion: on the table, in no hand.
    fn has_fallen(&self, objects: &ObjectsMemory, places: &Places) -> bool {
        let since = objects.captured.saturating_sub(self.suspected);
        objects.parts().any(|(kind, part)| {
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
