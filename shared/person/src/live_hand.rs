use bytemuck::{Pod, Zeroable};
use coact_messages::{HandPoints, KeypointName};
use coact_period::{PERIOD_S, cycles};
use coact_stage_state::{Implausible, ensure, finite};
use glam::DVec3;
use std::time::Duration;

/// How long a hand counts as being where it was shown last, cycles.
const LIFETIME: u64 = cycles(HandPoints::LIFETIME);
/// Longest time that the hand takes from one place that is shown to the next, cycles: three frames of 60 Hz. Chosen by hand.
const LONGEST_GLIDE: u64 = cycles(Duration::from_millis(50));
/// Time over which the wrist's speed is taken, s. Chosen by hand: 3 mm of scatter in each frame make 0.06 m/s of it, less than what
/// counts as movement.
const LAG: f64 = 0.05;
/// Speed of the wrist from which the hand moves, and below which it has stopped again, m/s. Chosen by hand: above the scatter of a
/// tracked hand, far below a reach.
const MOVES: f64 = 0.15;
const STOPS: f64 = 0.06;

/// A hand that is shown from outside, some 60 times a second.
///
/// Between two places that are shown it moves evenly, so that it is late by the time from one to the next, and has no steps.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct LiveHand {
    /// The keypoints from which it goes, m.
    from: [[f64; 3]; 9],
    /// Those that were shown last, m.
    to: [[f64; 3]; 9],
    /// Tick at which they were shown; 0: none were.
    shown: u64,
    /// How long it takes to go there, cycles.
    span: u64,
    /// Where the wrist was some time ago, averaged, m.
    trail: [f64; 3],
    /// 1 while it moves.
    moving: u64,
    /// Tick at which its present or last movement began.
    pub onset: u64,
    /// Where the fingers were when they opened last, m.
    pub opened_at: [f64; 3],
}

impl LiveHand {
    /// The hand is there.
    pub fn show(&mut self, tick: u64, points: &[[f64; 3]; 9]) {
        let tick = tick.max(1);
        let goes_on = self.is_seen(tick);
        self.from = if goes_on { self.at(tick).map(|point| point.to_array()) } else { *points };
        self.span = if goes_on { (tick - self.shown).clamp(1, LONGEST_GLIDE) } else { 1 };
        (self.to, self.shown) = (*points, tick);
        if !goes_on {
            (self.trail, self.moving) = (points[KeypointName::Wrist as usize], 0);
        }
    }

    /// Whether it is known at `tick` where the hand is.
    pub fn is_seen(&self, tick: u64) -> bool {
        self.shown > 0 && tick <= self.shown + LIFETIME
    }

    /// The keypoints at `tick`, m.
    pub fn at(&self, tick: u64) -> [DVec3; 9] {
        let along = (tick.saturating_sub(self.shown) as f64 / self.span.max(1) as f64).min(1.0);
        std::array::from_fn(|joint| DVec3::from(self.from[joint]).lerp(self.to[joint].into(), along))
    }

    /// Follows the wrist for a tick: whether it moves, and since when.
    pub fn follow(&mut self, tick: u64, wrist: DVec3) {
        let speed = self.speed(wrist);
        self.trail = DVec3::from(self.trail).lerp(wrist, PERIOD_S / LAG).into();
        if !self.moves() && speed > MOVES {
            (self.moving, self.onset) = (1, tick);
        } else if self.moves() && speed < STOPS {
            self.moving = 0;
        }
    }

    /// How fast the wrist, which is there, has moved of late, m/s.
    pub fn speed(&self, wrist: DVec3) -> f64 {
        wrist.distance(self.trail.into()) / LAG
    }

    /// Whether it moves.
    pub fn moves(&self) -> bool {
        self.moving != 0
    }

    /// Refuses what no hand can be that has been shown up to tick `now`.
    pub fn check(&self, now: u64) -> Result<(), Implausible> {
        // What was shown for the next tick.
        let been = self.shown <= now + 1 && self.onset <= now.max(1);
        ensure(been && self.span <= LONGEST_GLIDE, "person.live: tick", "one that has been")?;
        finite("person.live: keypoints", self.from.as_flattened())?;
        finite("person.live: keypoints", self.to.as_flattened())?;
        finite("person.live: place", &[self.trail, self.opened_at].concat())
    }
}
