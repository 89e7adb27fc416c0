use crate::{MotionState, Posture, Quintic};
use bytemuck::{Pod, Zeroable};

/// State of the arm at an instant of a trajectory.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Knot {
    /// Time since the start, s.
    pub t: f64,
    /// States of the joints then.
    pub states: [MotionState; 7],
}

impl Knot {
    /// The movement of each joint from here to the next knot.
    pub fn movement_to(&self, next: &Self) -> [Quintic; 7] {
        std::array::from_fn(|joint| Quintic::new(self.states[joint], next.states[joint], next.t - self.t))
    }
}

/// State of all joints of a movement through these knots, `t` s after its start; outside it the nearer end.
pub fn state_at(knots: &[Knot], t: f64) -> [MotionState; 7] {
    let next = knots.partition_point(|knot| knot.t <= t);
    match (next.checked_sub(1).map(|last| &knots[last]), knots.get(next)) {
        (Some(from), Some(to)) => from.movement_to(to).map(|piece| piece.at(t - from.t)),
        (None, Some(first)) => first.states,
        (Some(last), None) => last.states,
        (None, None) => [MotionState::default(); 7],
    }
}

/// Jerk of all joints of a movement through these knots, `t` s after its start, rad/s³; outside it 0.
pub fn jerk_at(knots: &[Knot], t: f64) -> Posture {
    let next = knots.partition_point(|knot| knot.t <= t);
    match (next.checked_sub(1).map(|last| &knots[last]), knots.get(next)) {
        (Some(from), Some(to)) => from.movement_to(to).map(|piece| piece.jerk(t - from.t)),
        _ => [0.0; 7],
    }
}
