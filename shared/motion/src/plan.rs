use crate::{SegmentKind, Target};
use bytemuck::{Pod, Zeroable};
use coact_robot::{JointLimits, MotionState, Posture, Quintic};

/// A planned movement: states of all joints at instants, and between them the polynomials of fifth degree that join
/// them with continuous velocity and acceleration.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The states, in the order of their instants; the first at 0 s.
    pub knots: Vec<Knot>,
    /// Segments, each with the instant at which it ends, s.
    pub segments: Vec<(SegmentKind, f64)>,
    /// Whether something stood in the way of the direct movement.
    pub bounces: bool,
    /// The goal that was chosen; none for a posture.
    pub target: Option<Target>,
}

/// State of the arm at an instant of a plan.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Knot {
    /// Time since the start, s.
    pub t: f64,
    /// States of the joints then.
    pub states: [MotionState; 7],
}

/// Instants between two knots at which a plan is held against the limits.
const CHECKED: u32 = 4;
/// Share of the limits that a movement from rest uses.
const USE: f64 = 0.95;

impl Plan {
    /// Most knots of a plan: one fits into memory of a fixed size.
    pub const KNOTS: usize = 32;

    /// Time of the whole movement, s.
    pub fn duration(&self) -> f64 {
        self.knots.last().map_or(0.0, |knot| knot.t)
    }

    /// State of all joints `t` s after the start; outside the movement the nearer end.
    pub fn at(&self, t: f64) -> [MotionState; 7] {
        state_at(&self.knots, t)
    }

    /// Posture at the end, rad.
    pub fn end(&self) -> Posture {
        self.knots.last().map_or([0.0; 7], |knot| knot.states.map(|state| state.position))
    }

    /// A joint that breaks a limit on the way, if one does.
    pub fn broken(&self, limits: &[JointLimits; 7]) -> Option<usize> {
        broken(self.samples(), limits)
    }

    /// How many times slower it must be to keep the limits of speed, acceleration and jerk.
    pub(crate) fn load(&self, limits: &[JointLimits; 7]) -> f64 {
        load(self.samples(), limits)
    }

    /// The same way, `factor` times slower; only for one that starts at rest.
    pub(crate) fn slower(mut self, factor: f64) -> Self {
        for knot in &mut self.knots {
            knot.t *= factor;
            for state in &mut knot.states {
                state.velocity /= factor;
                state.acceleration /= factor * factor;
            }
        }
        self.segments.iter_mut().for_each(|(_, end)| *end *= factor);
        self
    }

    /// Instants of the movement: `steps` in each piece, s.
    pub(crate) fn instants(&self, steps: u32) -> impl Iterator<Item = f64> {
        self.knots.windows(2).flat_map(move |pair| {
            let step = (pair[1].t - pair[0].t) / f64::from(steps);
            (1..=steps).map(move |index| pair[0].t + step * f64::from(index))
        })
    }

    /// States and jerks of all joints.
    fn samples(&self) -> impl Iterator<Item = ([MotionState; 7], Posture)> {
        self.knots.windows(2).flat_map(|pair| {
            let (pieces, duration) = (pieces(&pair[0], &pair[1]), pair[1].t - pair[0].t);
            (0..=CHECKED).map(move |step| {
                let t = duration * f64::from(step) / f64::from(CHECKED);
                (pieces.map(|piece| piece.at(t)), pieces.map(|piece| piece.jerk(t)))
            })
        })
    }
}

/// State of all joints of a movement through these knots, `t` s after its start; outside it the nearer end.
pub fn state_at(knots: &[Knot], t: f64) -> [MotionState; 7] {
    let next = knots.partition_point(|knot| knot.t <= t);
    match (next.checked_sub(1).map(|last| &knots[last]), knots.get(next)) {
        (Some(from), Some(to)) => pieces(from, to).map(|piece| piece.at(t - from.t)),
        (None, Some(first)) => first.states,
        (Some(last), None) => last.states,
        (None, None) => [MotionState::default(); 7],
    }
}

/// The first joint that breaks a limit in these states and jerks.
pub(crate) fn broken(
    mut samples: impl Iterator<Item = ([MotionState; 7], Posture)>,
    limits: &[JointLimits; 7],
) -> Option<usize> {
    samples
        .find_map(|(states, jerks)| (0..7).find(|&joint| !limits[joint].allows(&states[joint], jerks[joint])))
}

/// How many times slower a movement with these states and jerks must be to keep the limits, with a little room.
pub(crate) fn load(
    samples: impl Iterator<Item = ([MotionState; 7], Posture)>,
    limits: &[JointLimits; 7],
) -> f64 {
    let [mut velocity, mut acceleration, mut jerk] = [0.0f64; 3];
    for (states, jerks) in samples {
        for ((state, joint_jerk), limit) in states.iter().zip(jerks).zip(limits) {
            velocity = velocity.max(state.velocity.abs() / (USE * limit.velocity));
            acceleration = acceleration.max(state.acceleration.abs() / (USE * limit.acceleration));
            jerk = jerk.max(joint_jerk.abs() / (USE * limit.jerk));
        }
    }
    velocity.max(acceleration.sqrt()).max(jerk.cbrt())
}

fn pieces(from: &Knot, to: &Knot) -> [Quintic; 7] {
    std::array::from_fn(|joint| Quintic::new(from.states[joint], to.states[joint], to.t - from.t))
}
