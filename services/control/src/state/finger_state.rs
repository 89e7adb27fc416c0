use super::FINGER_JOINTS;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_period::{PERIOD_S, seconds};
use coact_robot::{MotionState, PointToPoint};
use coact_stage_state::{Flag, Implausible, bounded, ensure, finite};
use std::f64::consts::TAU;

/// How the fingers move: from one shape to the next.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct FingerState {
    /// Position, velocity and acceleration of each joint at the movement's start; rad, rad/s, rad/s².
    start: [[f64; 3]; FINGER_JOINTS],
    /// Where each comes to rest, rad.
    pub target: [f64; FINGER_JOINTS],
    /// Duration of the movement, s.
    duration: f64,
    /// Cycles since its start.
    elapsed: u64,
    /// Whether the fingers brake: a movement to the target begins anew, from rest, when they stand.
    pub braking: Flag,
}

/// No angle, speed or acceleration of a finger is greater; rad, rad/s, rad/s².
const MOST: f64 = 1e4;

impl FingerState {
    /// Standing still.
    pub fn at_rest(angles: [f64; FINGER_JOINTS]) -> Self {
        Self {
            start: angles.map(|angle| [angle, 0.0, 0.0]),
            target: angles,
            duration: PERIOD_S,
            elapsed: 1,
            braking: Flag::Unset,
        }
    }

    /// Puts a movement under way.
    pub fn follow(&mut self, movement: &PointToPoint<FINGER_JOINTS>) {
        *self = Self {
            start: movement.start.map(|state| [state.position, state.velocity, state.acceleration]),
            target: movement.target,
            duration: movement.duration,
            elapsed: 0,
            braking: Flag::Unset,
        };
    }

    /// Brakes; from rest it goes on to `target`.
    pub fn brake(&mut self, target: [f64; FINGER_JOINTS]) {
        (self.target, self.braking) = (target, Flag::Set);
    }

    /// Whether the fingers are at the end of their movement.
    pub fn has_arrived(&self) -> bool {
        !self.braking.is_set() && seconds(self.elapsed) >= self.duration
    }

    /// State of each joint now, as the movement has it.
    pub fn now(&self) -> [MotionState; FINGER_JOINTS] {
        self.after(0)
    }

    /// The same in the next cycle.
    pub fn next(&self) -> [MotionState; FINGER_JOINTS] {
        self.after(1)
    }

    /// Counts a cycle of the movement.
    pub fn advance(&mut self) {
        self.elapsed = self.elapsed.saturating_add(1);
    }

    fn after(&self, cycles: u64) -> [MotionState; FINGER_JOINTS] {
        if self.has_arrived() {
            return self.target.map(MotionState::at_rest);
        }
        let start = self.start.map(|[position, velocity, acceleration]| MotionState {
            position,
            velocity,
            acceleration,
        });
        let movement = PointToPoint { start, target: self.target, duration: self.duration };
        movement.at(seconds(self.elapsed.saturating_add(cycles)))
    }

    pub fn check(&self) -> Result<(), Implausible> {
        bounded("fingers.start", self.start.as_flattened(), MOST)?;
        bounded("fingers.target", &self.target, TAU)?;
        ensure(self.duration > 0.0, "fingers.duration", "a time above 0 s")?;
        finite("fingers.duration", &[self.duration])
    }
}
