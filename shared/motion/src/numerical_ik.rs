use crate::frames::Frames;
use crate::posture_cost::{WEIGHT, cost};
use crate::quadratic_program::QuadraticProgram;
use crate::{Clearance, Proximity};
use coact_robot::{HandGoal, Posture};
use nalgebra::{Isometry3, Vector3};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Inverse kinematics by sequential quadratic programming, for arms without a closed form: the posture nearest to the
/// present one at which the hand is at its goal, within the joint limits and clear of everything.
pub(crate) struct NumericalIk<'a> {
    pub clearance: Clearance<'a>,
    pub from: &'a Posture,
    /// Clearance that is required, m.
    pub min_clearance: f64,
}

/// Steps from one start at most. Chosen by hand.
const STEPS: u32 = 40;
/// Largest change of a joint in one step, rad: within it the hand's path is nearly linear in the joints. Chosen by hand.
const TRUST: f64 = 0.4;
/// The trust region shrinks to this fraction after a step that gains less than `LEAST_GAIN` rad², and after one that loses;
/// the search ends when it is smaller than `LEAST_TRUST` rad. Chosen by hand.
const SHRINKING: f64 = 0.5;
const SHRINKING_AFTER_LOSS: f64 = 0.4;
const LEAST_GAIN: f64 = 1e-5;
const LEAST_TRUST: f64 = 1e-4;
/// Errors that count as none: of the grasp point, m, and of the palm's rotation, rad. Chosen by hand: far below the
/// millimetre to which targets of planners in posture space are usually held.
const POSITION_TOLERANCE: f64 = 1e-4;
const ROTATION_TOLERANCE: f64 = 1e-3;
/// Links nearer than this become constraints of a step, m. Chosen by hand: a step must not run
/// into what it does not know.
const WATCHED: f64 = 0.1;
/// Clearance beyond the required one that a step aims at, m: it only covers the solver's rounding.
const ROUNDING: f64 = 1e-4;
/// Distance from the joint limits that is kept, rad: 1 degree.
const FROM_LIMITS: f64 = 0.0175;
/// Cost of each metre or rad by which constraints are not met, rad²: large against the cost of any posture's change by
/// a fraction of a rad. Chosen by hand.
const PENALTY: f64 = 100.0;
/// Seed of the random starts: any; fixed, so that the same problem has the same solution.
const SEED: u64 = 7;
/// Length of a cross product below which two directions count as parallel.
const PARALLEL: f64 = 1e-9;

impl NumericalIk<'_> {
    /// The present posture, and random ones within the limits.
    pub fn starts(&self, count: u32) -> Vec<Posture> {
        let mut random = Pcg64::seed_from_u64(SEED);
        let limits = self.clearance.mechanism.limits();
        let joints = self.clearance.mechanism.joints();
        let drawn = (0..count).map(|_| random_posture(&mut random, &limits, joints));
        std::iter::once(*self.from).chain(drawn).collect()
    }

    /// The posture with the palm at the goal, turned by `roll` rad (free when the goal says so), `back` m before it.
    pub fn solve(&self, goal: &HandGoal, roll: f64, back: f64, start: &Posture) -> Option<Posture> {
        let wanted = self.clearance.mechanism.palm_at(goal, roll, back);
        let is_free = goal.rolls == 0;
        let (mut at, mut trust) = (*start, TRUST);
        let mut near = Vec::new();
        let mut merit = self.merit(&at, &wanted, is_free, &mut near);
        for _ in 0..STEPS {
            let errors = pose_errors(&self.clearance, &at, &wanted, is_free);
            if is_there(&errors) && self.clearance.is_clear(&at, self.min_clearance) && trust < 0.5 * TRUST {
                return Some(at);
            }
            let step = self.step(&at, errors, trust)?;
            let next = std::array::from_fn(|joint| at[joint] + step[joint]);
            let after = self.merit(&next, &wanted, is_free, &mut near);
            if after < merit {
                let gain = merit - after;
                (at, merit) = (next, after);
                if gain < LEAST_GAIN {
                    trust *= SHRINKING;
                }
            } else {
                trust *= SHRINKING_AFTER_LOSS;
            }
            if trust < LEAST_TRUST {
                break;
            }
        }
        let is_there = is_there(&pose_errors(&self.clearance, &at, &wanted, is_free));
        (is_there && self.clearance.is_clear(&at, self.min_clearance)).then_some(at)
    }

    fn step(&self, at: &Posture, equal: Vec<(Posture, f64)>, trust: f64) -> Option<Posture> {
        let mechanism = self.clearance.mechanism;
        let limits = mechanism.limits();
        let mut near: Vec<Proximity> = Vec::new();
        self.clearance.near(at, WATCHED, &mut near);
        let bound = |near: &Proximity| self.min_clearance + ROUNDING - near.distance;
        let above = near.iter().map(|near| (near.gradient, bound(near))).collect();
        let within = |joint: usize, bound: f64| {
            if joint < mechanism.joints() { bound.clamp(-trust, trust) } else { 0.0 }
        };
        let program = QuadraticProgram {
            weight: WEIGHT,
            centre: std::array::from_fn(|joint| self.from[joint] - at[joint]),
            lower: std::array::from_fn(|j| within(j, (limits[j].lower + FROM_LIMITS - at[j]).min(0.0))),
            upper: std::array::from_fn(|j| within(j, (limits[j].upper - FROM_LIMITS - at[j]).max(0.0))),
            above,
            equal,
            penalty: PENALTY,
        };
        program.solve()
    }

    /// What the steps make smaller: the change of posture, and how far the constraints are not met.
    fn merit(&self, at: &Posture, wanted: &Isometry3<f64>, is_free: bool, near: &mut Vec<Proximity>) -> f64 {
        self.clearance.near(at, self.min_clearance, near);
        let short = near.iter().map(|near| self.min_clearance - near.distance).fold(0.0, f64::max);
        let errors = pose_errors(&self.clearance, at, wanted, is_free);
        let off = errors.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
        cost(at, self.from) + PENALTY * (short + off)
    }
}

fn is_there(errors: &[(Posture, f64)]) -> bool {
    let (position, rotation) = errors.split_at(3);
    position.iter().all(|(_, value)| value.abs() < POSITION_TOLERANCE)
        && rotation.iter().all(|(_, value)| value.abs() < ROTATION_TOLERANCE)
}

/// What is wrong with the palm's pose, each with its gradient: three lengths of the grasp point's position, m, then two
/// (where the roll is free) or three angles of the rotation, rad.
fn pose_errors(
    clearance: &Clearance,
    at: &Posture,
    wanted: &Isometry3<f64>,
    is_free: bool,
) -> Vec<(Posture, f64)> {
    let mechanism = clearance.mechanism;
    let count = mechanism.joints();
    let frames = Frames::of(mechanism, at);
    let palm = frames.pose[count - 1] * mechanism.arm.tool;
    let grasp = mechanism.grasp_point();
    let (here, there) = (palm * grasp, wanted * grasp);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let mut errors: Vec<(Posture, f64)> =
        axes.iter().map(|axis| (frames.gradient(&here, axis, count), (there - here).dot(axis))).collect();
    let (turn, about) = if is_free {
        let (z, aim) = (palm.rotation * Vector3::z(), wanted.rotation * Vector3::z());
        let across = [palm.rotation * Vector3::x(), palm.rotation * Vector3::y()];
        let angle = z.angle(&aim);
        let axis = z.cross(&aim).try_normalize(PARALLEL).unwrap_or(across[0]);
        (axis * angle, across.to_vec())
    } else {
        let difference = wanted.rotation * palm.rotation.inverse();
        (difference.scaled_axis(), axes.to_vec())
    };
    for axis in about {
        let gradient =
            std::array::from_fn(|joint| if joint < count { frames.axis[joint].dot(&axis) } else { 0.0 });
        errors.push((gradient, turn.dot(&axis)));
    }
    errors
}

/// A posture drawn evenly from the joint ranges.
pub(crate) fn random_posture(
    random: &mut impl Rng,
    limits: &[coact_robot::JointLimits; 7],
    joints: usize,
) -> Posture {
    std::array::from_fn(|joint| {
        if joint < joints { random.random_range(limits[joint].lower..limits[joint].upper) } else { 0.0 }
    })
}
