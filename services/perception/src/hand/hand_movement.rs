use crate::plausible_cycle::cycle;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::{Flag, Implausible, finite};
use nalgebra::Vector3;

/// Speed below which the hand counts as still, m/s: above what the tracker's scatter makes of a resting hand, far
/// below a reach, whose peak is at 0.8 m/s.
const STILL: f64 = 0.12;
/// Displacement from where the hand lay at which a movement has begun, m. Chosen by hand, a trade-off: a fidget is
/// no reach, and the onset of a reach is noticed the later, the farther the hand must have come.
const ONSET: f64 = 0.04;
/// Frames of stillness that end a movement: more than the turning point of one has. Chosen by hand.
const STILL_FRAMES: u64 = 4;
/// Weight of a new frame in the place where the hand lies still. Chosen by hand; not sensitive.
const SETTLING: f64 = 0.25;
/// How much the movement of the fingers counts, against that of the wrist: they open and close as well, and are seen less surely. Chosen by hand.
const FINGERS: f64 = 0.5;
/// Fraction of the peak speed below which the slow phase of a movement begins: the hand closes on the part. Chosen by
/// hand.
const SLOW: f64 = 0.4;
/// Peak speed that a movement must have had before its slow phase can begin, m/s: what is slower is no reach.
const BRISK: f64 = 0.35;

/// The hand's movement from one stillness to the next.
///
/// A hand moves with its wrist, or turns about it to what lies beside: then its fingers move, which count for half as much.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct HandMovement {
    /// Where the wrist lay still last, m.
    anchor: [f64; 3],
    /// Where its centre did, the middle between thumb and index tip, m.
    centre_anchor: [f64; 3],
    /// Whether that is known.
    centred: Flag,
    /// Where the wrist was as the present or last movement began, m.
    pub departure: [f64; 3],
    /// Frames of stillness up to now.
    still: u64,
    /// Whether a movement is under way.
    moving: Flag,
    /// Cycle at which the present or last movement began.
    pub onset: u64,
    /// Cycle at which its slow phase began; 0 before.
    pub slowed: u64,
    /// Its greatest speed so far, m/s.
    peak: f64,
    /// Newest speed, m/s.
    pub speed: f64,
}

impl HandMovement {
    /// A hand that lies still, with its wrist at `place`, m.
    pub fn still_at(place: Vector3<f64>) -> Self {
        Self { anchor: place.into(), departure: place.into(), ..Self::zeroed() }
    }

    /// One frame: where wrist and centre are (m; no centre where thumb or index tip are not seen), the hand's speed over the last frames (m/s) and
    /// the cycle of capture. True at onset.
    pub fn advance(
        &mut self,
        (wrist, centre): (Vector3<f64>, Option<Vector3<f64>>),
        speed: Option<f64>,
        captured: u64,
    ) -> bool {
        let is_still = speed.is_none_or(|speed| speed < STILL);
        self.still = if is_still { self.still + 1 } else { 0 };
        self.speed = speed.unwrap_or(0.0);
        if self.is_moving() {
            self.go_on((wrist, centre), captured);
            return false;
        }
        let displacement = extent(
            wrist - Vector3::from(self.anchor),
            centre.filter(|_| self.centred.is_set()).map(|centre| centre - Vector3::from(self.centre_anchor)),
        );
        let begun = displacement > ONSET && speed.is_some();
        if begun {
            (self.moving, self.onset, self.slowed, self.peak) = (Flag::Set, captured, 0, self.speed);
            self.departure = self.anchor;
        } else if is_still {
            settle(&mut self.anchor, wrist, SETTLING);
            self.settle_centre(centre, SETTLING);
        }
        begun
    }

    fn settle_centre(&mut self, centre: Option<Vector3<f64>>, weight: f64) {
        let Some(centre) = centre else { return };
        settle(&mut self.centre_anchor, centre, if self.centred.is_set() { weight } else { 1.0 });
        self.centred = Flag::Set;
    }

    fn go_on(&mut self, (wrist, centre): (Vector3<f64>, Option<Vector3<f64>>), captured: u64) {
        self.peak = self.peak.max(self.speed);
        if self.slowed == 0 && self.peak > BRISK && self.speed < SLOW * self.peak {
            self.slowed = captured;
        }
        if self.still >= STILL_FRAMES {
            self.moving = Flag::Unset;
            self.anchor = wrist.into();
            self.centred = Flag::Unset;
            self.settle_centre(centre, 1.0);
        }
    }

    /// Refuses what is no state of it.
    pub fn check(&self) -> Result<(), Implausible> {
        cycle("hand.movement.still", self.still)?;
        finite("hand.movement.anchor", [self.anchor, self.centre_anchor].as_flattened())?;
        finite("hand.movement.departure", &self.departure)?;
        finite("hand.movement.speed", &[self.peak, self.speed])
    }

    /// Where the wrist lay still last, m.
    pub fn place_of_stillness(&self) -> [f64; 3] {
        self.anchor
    }

    /// Whether a movement is under way.
    pub fn is_moving(&self) -> bool {
        self.moving.is_set()
    }
}

/// How far a hand has moved whose wrist and centre have moved so, m; or how fast, of their velocities.
pub(super) fn extent(wrist: Vector3<f64>, centre: Option<Vector3<f64>>) -> f64 {
    centre.map_or(0.0, |centre| FINGERS * centre.norm()).max(wrist.norm())
}

/// Moves the place where something lies still towards where it is now.
fn settle(anchor: &mut [f64; 3], now: Vector3<f64>, weight: f64) {
    let before = Vector3::from(*anchor);
    *anchor = (before + (now - before) * weight).into();
}
