use crate::comfort::{WEIGHT, cost};
use crate::frames::Frames;
use crate::quadratic::Quadratic;
use crate::{Clearance, Proximity};
use coact_robot::{HandGoal, Posture};
use nalgebra::{Isometry3, Vector3};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Inverse kinematics by sequential quadratic programming, for arms without a closed form: the posture nearest to the
/// present one at which the hand is at its goal, within the joint limits and clear of everything.
pub(crate) struct Solver<'a> {
    pub clearance: Clearance<'a>,
    pub from: &'a Posture,
    /// Distance that is kept, m.
    pub margin: f64,
}

/// Steps of one run.
const STEPS: u32 = 40;
/// Largest change of a joint in one step, rad.
const TRUST: f64 = 0.4;
/// What counts as there: m, and rad.
const THERE: (f64, f64) = (1e-4, 1e-3);
/// Links nearer than this are watched, m.
const WATCHED: f64 = 0.1;
/// Distance from the joint limits, rad.
const FROM_LIMITS: f64 = 0.0175;

impl Solver<'_> {
    /// The present posture and random ones within the limits.
    pub fn starts(&self, count: u32) -> Vec<Posture> {
        let mut random = Pcg64::seed_from_u64(7);
        let limits = self.clearance.mechanism.limits();
        let joints = self.clearance.mechanism.joints();
        let anywhere = (0..count).map(|_| anywhere(&mut random, &limits, joints));
        std::iter::once(*self.from).chain(anywhere).collect()
    }

    /// The posture with the palm at the goal, turned by `roll` rad (free when the goal says so), `back` m before it.
    pub fn reach(&self, goal: &HandGoal, roll: f64, back: f64, start: &Posture) -> Option<Posture> {
        let mechanism = self.clearance.mechanism;
        let wanted = mechanism.palm_at(goal, roll, back);
        let (mut at, mut trust) = (*start, TRUST);
        let mut near = Vec::new();
        let mut merit = self.merit(&at, &wanted, goal.rolls == 0, &mut near);
        for _ in 0..STEPS {
            let demands = demands(&self.clearance, &at, &wanted, goal.rolls == 0);
            if is_met(&demands) && self.clearance.is_clear(&at, self.margin) && trust < 0.5 * TRUST {
                return Some(at);
            }
            let step = self.step(&at, demands, trust)?;
            let next = std::array::from_fn(|joint| at[joint] + step[joint]);
            let after = self.merit(&next, &wanted, goal.rolls == 0, &mut near);
            if after < merit {
                let gain = merit - after;
                (at, merit) = (next, after);
                if gain < 1e-5 {
                    trust *= 0.5;
                }
            } else {
                trust *= 0.4;
            }
            if trust < 1e-4 {
                break;
            }
        }
        let met = is_met(&demands(&self.clearance, &at, &wanted, goal.rolls == 0));
        (met && self.clearance.is_clear(&at, self.margin)).then_some(at)
    }

    fn step(&self, at: &Posture, equal: Vec<(Posture, f64)>, trust: f64) -> Option<Posture> {
        let mechanism = self.clearance.mechanism;
        let limits = mechanism.limits();
        let mut near: Vec<Proximity> = Vec::new();
        self.clearance.near(at, WATCHED, &mut near);
        let above = near.iter().map(|near| (near.gradient, self.margin + 1e-4 - near.distance)).collect();
        let within = |joint: usize, bound: f64| {
            if joint < mechanism.joints() { bound.clamp(-trust, trust) } else { 0.0 }
        };
        let problem = Quadratic {
            weight: WEIGHT,
            centre: std::array::from_fn(|joint| self.from[joint] - at[joint]),
            lower: std::array::from_fn(|j| within(j, (limits[j].lower + FROM_LIMITS - at[j]).min(0.0))),
            upper: std::array::from_fn(|j| within(j, (limits[j].upper - FROM_LIMITS - at[j]).max(0.0))),
            above,
            equal,
            penalty: 100.0,
        };
        problem.solve()
    }

    /// What a run makes smaller: the way of the joints, and how far the demands are not met.
    fn merit(&self, at: &Posture, wanted: &Isometry3<f64>, free: bool, near: &mut Vec<Proximity>) -> f64 {
        self.clearance.near(at, self.margin, near);
        let short = near.iter().map(|near| self.margin - near.distance).fold(0.0, f64::max);
        let off = demands(&self.clearance, at, wanted, free)
            .iter()
            .map(|(_, value)| value.abs())
            .fold(0.0, f64::max);
        cost(at, self.from) + 100.0 * (short + off)
    }
}

fn is_met(demands: &[(Posture, f64)]) -> bool {
    let (place, turn) = demands.split_at(3);
    place.iter().all(|(_, value)| value.abs() < THERE.0)
        && turn.iter().all(|(_, value)| value.abs() < THERE.1)
}

/// What the next step must change: three lengths of the palm's place, m, then two or three angles of its turn, rad.
fn demands(clearance: &Clearance, at: &Posture, wanted: &Isometry3<f64>, free: bool) -> Vec<(Posture, f64)> {
    let mechanism = clearance.mechanism;
    let count = mechanism.joints();
    let frames = Frames::of(mechanism, at);
    let palm = frames.pose[count - 1] * mechanism.arm.tool;
    let grasp = mechanism.grasp_point();
    let (here, there) = (palm * grasp, wanted * grasp);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let mut rows: Vec<(Posture, f64)> =
        axes.iter().map(|axis| (frames.gradient(&here, axis, count), (there - here).dot(axis))).collect();
    let (turn, about) = if free {
        let (z, goal) = (palm.rotation * Vector3::z(), wanted.rotation * Vector3::z());
        let across = [palm.rotation * Vector3::x(), palm.rotation * Vector3::y()];
        let angle = z.angle(&goal);
        let axis = z.cross(&goal).try_normalize(1e-9).unwrap_or(across[0]);
        (axis * angle, across.to_vec())
    } else {
        let difference = wanted.rotation * palm.rotation.inverse();
        (difference.scaled_axis(), axes.to_vec())
    };
    for axis in about {
        let gradient =
            std::array::from_fn(|joint| if joint < count { frames.axis[joint].dot(&axis) } else { 0.0 });
        rows.push((gradient, turn.dot(&axis)));
    }
    rows
}

/// A random posture for the search of ways.
pub(crate) fn anywhere(
    random: &mut impl Rng,
    limits: &[coact_robot::JointLimits; 7],
    joints: usize,
) -> Posture {
    std::array::from_fn(|joint| {
        if joint < joints { random.random_range(limits[joint].lower..limits[joint].upper) } else { 0.0 }
    })
}
