//! The search for the smallest bounce on a reach that keeps clear: sequential quadratic programming with a trust region
//! (as in Schulman et al., Int. J. Robotics Research 33, 2014) over the seven joints of the bounce posture (Rosenbaum et
//! al., Psychol. Rev. 108, 2001).

use crate::attempt::{Attempt, BETWEEN_POINTS};
use crate::numerical_ik::random_posture;
use crate::posture_cost::{WEIGHT, cost};
use crate::quadratic_program::QuadraticProgram;
use crate::segment_check::SPARSE;
use crate::segment_motion::bounce_profile;
use crate::{Refusal, Segment, SegmentKind, SegmentMotion};
use coact_robot::Posture;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::ops::Range;

/// Steps of one search at most. Chosen by hand.
const STEPS: u32 = 25;
/// Links (m) and joint limits (rad) that are nearer than this, beyond what is required, become constraints of a step.
/// Chosen by hand: a step must not run into what it does not know, and more constraints cost time.
const NEARBY: f64 = 0.06;
/// Constraints of one step at most, the nearest ones. A trade-off with the solver's time.
const CONSTRAINTS: usize = 120;
/// Largest change of a joint's bounce in the first step, rad. Chosen by hand.
const TRUST: f64 = 0.5;
/// After a step that gains less than `LEAST_GAIN` (rad²) the trust region shrinks to this fraction; the search ends when
/// it is smaller than `LEAST_TRUST` rad. Chosen by hand.
const SHRINKING: f64 = 0.4;
const LEAST_GAIN: f64 = 1e-3;
const LEAST_TRUST: f64 = 0.01;
/// Cost of each metre (or rad) by which the worst constraint is not met, rad²: 1 mm costs as much as a bounce of nearly
/// half a rad in one joint. Chosen by hand.
const PENALTY: f64 = 200.0;
/// Random bounces are drawn ever farther from the middle of the direct reach: by this fraction of the joint ranges more
/// in each attempt, at most by the other. Chosen by hand.
const SPREAD: f64 = 0.12;
const WIDEST: f64 = 0.9;
/// Postures that are drawn at most until one is clear. Chosen by hand.
const DRAWS: u32 = 40;
/// Seed of the first random bounce; each attempt has its own. Any; fixed, so that the same problem has the same plan.
const SEED: u64 = 10;

/// A constraint of one step: the distance from it at present, its gradient by the bounce, and the least change.
struct Constraint {
    distance: f64,
    gradient: Posture,
    bound: f64,
}

impl Attempt<'_> {
    /// The movement with the smallest bounce that keeps clear, found from these starts, one after the other: the first is
    /// the direct movement, the others are random, ever farther from it.
    ///
    /// # Errors
    /// [`Refusal::NoPath`] when nothing was found.
    pub fn find_bounce(&self, direct: &[Segment], attempts: Range<u32>) -> Result<Vec<Segment>, Refusal> {
        self.check_straight_segments(direct)?;
        let Some(reach) = reach(direct) else { return Ok(direct.to_vec()) };
        let Some(closest) = self.closest(&reach) else { return Ok(direct.to_vec()) };
        for attempt in attempts {
            let bounce = if attempt == 0 { [0.0; 7] } else { self.random_bounce(&reach, attempt) };
            if let Some(found) = self.shrink(bounce, &reach) {
                return Ok(found);
            }
        }
        Err(self.no_path(&closest))
    }

    /// The movement with the smallest bounce near one of these postures, half-way through the reach.
    pub fn find_bounce_near(&self, vias: &[Posture]) -> Option<Vec<Segment>> {
        let direct = self.direct().ok()?;
        self.check_straight_segments(&direct).ok()?;
        let reach = reach(&direct)?;
        vias.iter().find_map(|via| self.shrink(bounce_to(via, &reach), &reach))
    }

    /// From this bounce, to the smallest one nearby that keeps clear.
    fn shrink(&self, mut bounce: Posture, direct: &SegmentMotion) -> Option<Vec<Segment>> {
        let mut trust = TRUST;
        let with = |bounce: Posture| SegmentMotion { bounce, ..*direct };
        let mut merit = self.merit(&with(bounce));
        for _ in 0..STEPS {
            // A step and its merit look at each of the sparse points.
            if !self.budget.spend(2 * SPARSE) {
                return None;
            }
            let step = self.step(&with(bounce), trust)?;
            let next = std::array::from_fn(|joint| bounce[joint] + step[joint]);
            let after = self.merit(&with(next));
            let gain = merit - after;
            if gain > 0.0 {
                (bounce, merit) = (next, after);
            }
            if gain < LEAST_GAIN {
                trust *= SHRINKING;
            }
            if trust < LEAST_TRUST {
                break;
            }
        }
        let found = self.timed(bounce).ok()?;
        let is_clear = reach(&found).is_some_and(|reach| self.closest(&reach).is_none());
        is_clear.then_some(found)
    }

    /// The change of the bounce that the next step makes: the solution of the linearised problem.
    fn step(&self, reach: &SegmentMotion, trust: f64) -> Option<Posture> {
        let mut constraints = self.constraints(reach);
        constraints.sort_by(|one, other| one.distance.total_cmp(&other.distance));
        constraints.truncate(CONSTRAINTS);
        let mechanism = self.clearance.mechanism;
        let largest = |joint: usize| if joint < mechanism.joints() { trust } else { 0.0 };
        let program = QuadraticProgram {
            weight: WEIGHT,
            centre: reach.bounce.map(|offset| -offset),
            lower: std::array::from_fn(|joint| -largest(joint)),
            upper: std::array::from_fn(largest),
            above: constraints
                .into_iter()
                .map(|constraint| (constraint.gradient, constraint.bound))
                .collect(),
            equal: Vec::new(),
            penalty: PENALTY,
        };
        program.solve()
    }

    fn constraints(&self, reach: &SegmentMotion) -> Vec<Constraint> {
        let mut constraints = Vec::new();
        let mut near = Vec::new();
        for (s, posture, required) in self.inner_points(reach) {
            let [effect, ..] = bounce_profile(s);
            self.clearance.near(&posture, required + NEARBY, &mut near);
            constraints.extend(near.iter().map(|near| Constraint {
                distance: near.distance,
                gradient: near.gradient.map(|gradient| effect * gradient),
                bound: required - near.distance,
            }));
            self.add_limits(&posture, effect, &mut constraints);
        }
        constraints
    }

    /// Constraints that joints which come near their limits stay within them.
    fn add_limits(&self, posture: &Posture, effect: f64, constraints: &mut Vec<Constraint>) {
        let joints = self.limits.iter().zip(posture).take(self.clearance.mechanism.joints());
        for (joint, (limit, angle)) in joints.enumerate() {
            let unit =
                |sign: f64| std::array::from_fn(|other| if other == joint { sign * effect } else { 0.0 });
            for (sign, distance) in [(1.0, angle - limit.lower), (-1.0, limit.upper - angle)] {
                if distance < NEARBY {
                    constraints.push(Constraint { distance, gradient: unit(sign), bound: -distance });
                }
            }
        }
    }

    /// Size of the bounce, and how far the worst constraint is not met.
    fn merit(&self, reach: &SegmentMotion) -> f64 {
        let mut short = 0.0f64;
        for (_, posture, required) in self.inner_points(reach) {
            if let Some(near) = self.clearance.nearest(&posture, required - short) {
                short = short.max(required - near.distance);
            }
            for (limit, angle) in self.limits.iter().zip(&posture) {
                short = short.max(limit.lower - angle).max(angle - limit.upper);
            }
        }
        cost(&reach.bounce, &[0.0; 7]) + PENALTY * short
    }

    /// Points of a reach between its ends: fraction of the duration, posture, and the clearance that is required, m.
    fn inner_points(&self, reach: &SegmentMotion) -> impl Iterator<Item = (f64, Posture, f64)> {
        (1..SPARSE).map(|point| {
            let s = f64::from(point) / f64::from(SPARSE);
            (s, reach.posture(s), self.min_clearance.at(s) + BETWEEN_POINTS)
        })
    }

    /// A bounce to a random posture that is clear of everything, the farther from the middle of the direct reach the later
    /// the attempt.
    fn random_bounce(&self, reach: &SegmentMotion, attempt: u32) -> Posture {
        let mut random = Pcg64::seed_from_u64(SEED + u64::from(attempt));
        let middle = reach.posture(0.5);
        let joints = self.clearance.mechanism.joints();
        let fraction = (SPREAD * f64::from(attempt)).min(WIDEST);
        let mut posture = middle;
        for _ in 0..DRAWS {
            let drawn = random_posture(&mut random, &self.limits, joints);
            posture = std::array::from_fn(|joint| middle[joint] + fraction * (drawn[joint] - middle[joint]));
            if self.clearance.is_clear(&posture, self.min_clearance.path) {
                break;
            }
        }
        bounce_to(&posture, reach)
    }
}

/// The bounce with which a reach is at a posture half-way.
fn bounce_to(posture: &Posture, reach: &SegmentMotion) -> Posture {
    let middle = reach.posture(0.5);
    std::array::from_fn(|joint| reach.bounce[joint] + posture[joint] - middle[joint])
}

/// The first reach of these segments.
fn reach(segments: &[Segment]) -> Option<SegmentMotion> {
    segments.iter().find(|segment| segment.kind == SegmentKind::Reach).map(|segment| segment.motion)
}
