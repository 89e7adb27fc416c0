use crate::{StageKind, Target};
use coact_robot::{JointLimits, MotionState, Posture, Quintic};

/// A planned movement: states of all joints at instants, and between them the polynomials of fifth degree that join
/// them with continuous velocity and acceleration.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The states, in the order of their instants; the first at 0 s.
    pub knots: Vec<Knot>,
    /// Stages, each with the instant at which it ends, s.
    pub stages: Vec<(StageKind, f64)>,
    /// Whether the way is anything but direct.
    pub bounces: bool,
    /// The goal that was chosen; none for a posture.
    pub target: Option<Target>,
}

/// State of the arm at an instant of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Time since the start, s.
    pub t: f64,
    /// States of the joints then.
    pub states: [MotionState; 7],
}

/// Instants between two knots at which a plan is held against the limits.
const CHECKED: u32 = 4;

impl Plan {
    /// Time of the whole movement, s.
    pub fn duration(&self) -> f64 {
        self.knots.last().map_or(0.0, |knot| knot.t)
    }

    /// State of all joints `t` s after the start; outside the movement the nearer end.
    pub fn at(&self, t: f64) -> [MotionState; 7] {
        let next = self.knots.partition_point(|knot| knot.t <= t);
        match (next.checked_sub(1).map(|last| &self.knots[last]), self.knots.get(next)) {
            (Some(from), Some(to)) => pieces(from, to).map(|piece| piece.at(t - from.t)),
            (None, Some(first)) => first.states,
            (Some(last), None) => last.states,
            (None, None) => [MotionState::default(); 7],
        }
    }

    /// Posture at the end, rad.
    pub fn end(&self) -> Posture {
        self.knots.last().map_or([0.0; 7], |knot| knot.states.map(|state| state.position))
    }

    /// A joint that breaks a limit on the way, if one does.
    pub fn broken(&self, limits: &[JointLimits; 7]) -> Option<usize> {
        self.knots.windows(2).find_map(|pair| {
            let pieces = pieces(&pair[0], &pair[1]);
            (0..7).find(|&joint| {
                (0..=CHECKED).any(|step| {
                    let t = (pair[1].t - pair[0].t) * f64::from(step) / f64::from(CHECKED);
                    let (state, limit) = (pieces[joint].at(t), &limits[joint]);
                    !limit.contain(state.position, -1e-9)
                        || state.velocity.abs() > limit.velocity
                        || state.acceleration.abs() > limit.acceleration
                        || pieces[joint].jerk(t).abs() > limit.jerk
                })
            })
        })
    }
}

fn pieces(from: &Knot, to: &Knot) -> [Quintic; 7] {
    std::array::from_fn(|joint| Quintic::new(from.states[joint], to.states[joint], to.t - from.t))
}
