use crate::{SegmentKind, Target};
use coact_robot::{JointLimits, Knot, MotionState, Posture, state_at};

/// A planned trajectory: states of all joints at instants (knots), joined by polynomials of fifth degree, so that velocity
/// and acceleration are continuous.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plan {
    /// The states, in the order of their instants; the first at 0 s.
    pub knots: Vec<Knot>,
    /// The kind of each segment, and when it ends, s.
    pub segments: Vec<(SegmentKind, f64)>,
    /// Whether the direct movement was not clear: the arm goes around something.
    pub bounces: bool,
    /// The posture at the goal of the hand that was chosen; none when the goal was a posture.
    pub target: Option<Target>,
    /// The shortest time in which the path can be followed under the limits of speed and acceleration and with the hand's speeds, whatever the jerk, s;
    /// infinite where the limits of speed at its start alone forbid it, and where it leads nowhere.
    pub shortest: f64,
}

/// Steps between two knots at whose ends limits are checked. Chosen by hand: peaks between them lie within what
/// [`USED`] leaves.
const CHECKED: u32 = 4;
/// Fraction of the limits that a movement from rest uses. Chosen by hand: the rest is room for peaks between
/// samples.
pub(crate) const USED: f64 = 0.95;
/// Steps between two knots at whose ends the speed is held against [`Plan::FASTEST`].
const LOOKED_AT: u32 = 24;

impl Plan {
    /// Fraction of the speed limits that no movement exceeds, at whatever instant: to be less than what a drive lets setpoints come up to,
    /// for one that is faster is broken off, joint by joint. A wrist that still lagged then braked with 1.3 times its acceleration.
    pub const FASTEST: f64 = 0.98;

    /// Most knots of a plan: it fits into messages of a fixed size. A trade-off: 32 follow the path of hand and joints
    /// closely enough to stay clear, and take 5.6 kB.
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

    /// The first joint that breaks a limit during the movement, if one does.
    pub fn broken(&self, limits: &[JointLimits; 7]) -> Option<usize> {
        broken(self.samples(), limits)
    }

    /// How many times slower it must be to keep the limits of speed, acceleration and jerk.
    pub(crate) fn load(&self, limits: &[JointLimits; 7]) -> f64 {
        load(self.samples(), limits)
    }

    /// The same path, `factor` times slower; only for a plan that starts at rest.
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

    /// The same path, slower if a joint's speed peaks too near to its limit.
    ///
    /// # Errors
    /// That joint, when the movement is under way and can be no slower.
    pub(crate) fn below_speed_limits(self, limits: &[JointLimits; 7]) -> Result<Self, usize> {
        let (joint, speed) = self.fastest(limits);
        let begins_at_rest =
            self.knots.first().is_none_or(|knot| knot.states.iter().all(MotionState::is_at_rest));
        match speed <= Self::FASTEST {
            true => Ok(self),
            false if begins_at_rest => Ok(self.slower(speed / Self::FASTEST)),
            false => Err(joint),
        }
    }

    /// The joint that comes nearest to its speed limit, and the fraction of it.
    fn fastest(&self, limits: &[JointLimits; 7]) -> (usize, f64) {
        let speeds = self.instants(LOOKED_AT).flat_map(|t| {
            let states = self.at(t);
            (0..7).map(move |joint| (joint, states[joint].velocity.abs() / limits[joint].velocity))
        });
        speeds.fold((0, 0.0), |most, speed| if speed.1 > most.1 { speed } else { most })
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
            let (pieces, duration) = (pair[0].movement_to(&pair[1]), pair[1].t - pair[0].t);
            (0..=CHECKED).map(move |step| {
                let t = duration * f64::from(step) / f64::from(CHECKED);
                (pieces.map(|piece| piece.at(t)), pieces.map(|piece| piece.jerk(t)))
            })
        })
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

/// How many times slower a movement with these states and jerks must be to use [`USED`] of the limits.
pub(crate) fn load(
    samples: impl Iterator<Item = ([MotionState; 7], Posture)>,
    limits: &[JointLimits; 7],
) -> f64 {
    let [mut velocity, mut acceleration, mut jerk] = [0.0f64; 3];
    for (states, jerks) in samples {
        for ((state, joint_jerk), limit) in states.iter().zip(jerks).zip(limits) {
            velocity = velocity.max(state.velocity.abs() / (USED * limit.velocity));
            acceleration = acceleration.max(state.acceleration.abs() / (USED * limit.acceleration));
            jerk = jerk.max(joint_jerk.abs() / (USED * limit.jerk));
        }
    }
    velocity.max(acceleration.sqrt()).max(jerk.cbrt())
}
