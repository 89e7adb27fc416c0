use crate::guide::Guide;
use crate::plan::load;
use crate::straight::Change;
use crate::{Clearance, HandPath, Mechanism, Segment, SegmentKind, SegmentMotion, bell, straight};
use coact_robot::{JointLimits, MotionState, Posture};
use nalgebra::{DMatrix, DVector};

/// Postures that a movement passes, and how.
#[derive(Debug, Clone)]
pub(crate) struct Route {
    /// State at the start.
    pub start: [MotionState; 7],
    /// Segments, each with the posture at its end.
    pub legs: Vec<(SegmentKind, Posture)>,
    /// Share of the time that each segment takes.
    pub shares: Vec<f64>,
    /// How the postures between segments are passed.
    pub passing: Passing,
    /// Excursion of the reach, rad.
    pub bounce: Posture,
}

/// How a posture between two segments is passed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Passing {
    /// With the velocity and acceleration of least jerk of the whole movement.
    Smooth,
    /// In the direction of the straight segment beside it, with this multiple of its mean speed.
    Straight(f64),
    /// In these states, as for a movement of 1 s.
    Given(Vec<[MotionState; 7]>),
}

/// What a change of a joint counts for in the length of a way, m/rad: it matters where the hand only turns.
const TURNING: f64 = 0.05;
/// Pieces in which a way is measured.
const MEASURED: u32 = 8;
/// Places at which the hand's path is looked at.
const LOOKED_AT: usize = 80;
/// Factors by which the time of the first and the last segment is changed in search of the smoothest movement.
const FACTORS: [f64; 6] = [0.8, 0.64, 0.5, 1.25, 1.6, 2.0];
/// Shortest movement, s.
const SHORTEST: f64 = 0.1;
/// Movements that do not begin at rest are slowed down in such steps, so many at most.
const SLOWER: (f64, u32) = (1.04, 60);

impl Route {
    /// A route whose segments take the time in which a hand with one bell of speed would cover them.
    pub fn new(
        mechanism: &Mechanism,
        start: [MotionState; 7],
        legs: Vec<(SegmentKind, Posture)>,
        passing: Passing,
    ) -> Self {
        let from = start.map(|state| state.position);
        let ends = legs.iter().map(|(_, posture)| *posture);
        let lengths: Vec<f64> = std::iter::once(from)
            .chain(ends.clone())
            .zip(ends)
            .map(|(from, to)| length(mechanism, &from, &to))
            .collect();
        let total: f64 = lengths.iter().sum();
        let passed = lengths.iter().scan(0.0, |covered, length| {
            *covered += length / total.max(1e-9);
            Some(time_of_bell(*covered))
        });
        let passed: Vec<f64> = passed.collect();
        let shares = (0..legs.len()).map(|leg| {
            let before = leg.checked_sub(1).map_or(0.0, |before| passed[before]);
            let after = if leg + 1 == legs.len() { 1.0 } else { passed[leg] };
            (after - before).max(1e-3)
        });
        Self { start, shares: shares.collect(), legs, passing, bounce: [0.0; 7] }
    }

    /// The same route with the shares of time for which the hand moves most smoothly.
    pub fn smoothest(mut self, mechanism: &Mechanism, limits: &[JointLimits; 7]) -> Self {
        let mut best = self.roughness(mechanism, limits);
        for leg in 0..self.legs.len() {
            if self.legs[leg].0 == SegmentKind::Reach {
                continue;
            }
            let share = self.shares[leg];
            let mut chosen = share;
            for factor in FACTORS {
                self.shares[leg] = factor * share;
                let roughness = self.roughness(mechanism, limits);
                if roughness < best {
                    (best, chosen) = (roughness, self.shares[leg]);
                }
            }
            self.shares[leg] = chosen;
        }
        self
    }

    /// The change for which hand and joints move most smoothly. `segments`: the route's own.
    pub fn smoothing<'a>(
        &self,
        mechanism: &'a Mechanism,
        segments: &[Segment],
        room: &dyn Fn(f64) -> (Clearance<'a>, f64),
        guides: &[Guide],
    ) -> Change {
        straight::smoothest(mechanism, segments, self.passing == Passing::Smooth, room, guides)
    }

    /// The same route with a change of these segments, its own.
    pub fn changed(&self, segments: &[Segment], change: &Change) -> Self {
        let reach = segments.iter().find(|segment| segment.kind == SegmentKind::Reach);
        let bounce = reach.map_or([0.0; 7], |reach| reach.motion.bounce);
        let mut route = Self {
            bounce: std::array::from_fn(|joint| bounce[joint] + change.bounce[joint]),
            ..self.clone()
        };
        if self.passing == Passing::Smooth {
            let total: f64 = segments.iter().map(|segment| segment.motion.duration).sum();
            let given =
                segments.iter().zip(&change.passed).map(|(segment, [position, velocity, acceleration])| {
                    let end = segment.motion.end;
                    std::array::from_fn(|joint| MotionState {
                        position: end[joint].position + position[joint],
                        velocity: end[joint].velocity * total + velocity[joint],
                        acceleration: end[joint].acceleration * total.powi(2) + acceleration[joint],
                    })
                });
            route.passing = Passing::Given(given.collect());
        }
        route
    }

    /// How far the hand's movement is from one smooth bell.
    fn roughness(&self, mechanism: &Mechanism, limits: &[JointLimits; 7]) -> f64 {
        self.timed(limits).map_or(f64::INFINITY, |segments| {
            let path = HandPath::of(mechanism, &bell::sampled(&segments), LOOKED_AT);
            path.normalised_jerk() * f64::from(path.units())
        })
    }

    /// The shortest movement along the route within the limits.
    ///
    /// # Errors
    /// The joint that breaks a limit however long the movement takes.
    pub fn timed(&self, limits: &[JointLimits; 7]) -> Result<Vec<Segment>, usize> {
        let resting =
            Self { start: self.start.map(|state| MotionState::at_rest(state.position)), ..self.clone() };
        let mut duration = shortest(&resting.segments(1.0), limits);
        if self.start.iter().all(MotionState::is_at_rest) {
            let segments = self.segments(duration);
            return broken(&segments, limits, 1.0 + 1e-3).map_or(Ok(segments), Err);
        }
        let mut joint = 0;
        for _ in 0..SLOWER.1 {
            let segments = self.segments(duration);
            match broken(&segments, limits, 1.0) {
                None => return Ok(segments),
                Some(broken) => joint = broken,
            }
            duration *= SLOWER.0;
        }
        Err(joint)
    }

    /// The segments of a movement of this duration, s.
    fn segments(&self, duration: f64) -> Vec<Segment> {
        let total: f64 = self.shares.iter().sum();
        let times: Vec<f64> = self.shares.iter().map(|share| share / total * duration).collect();
        let mut passed: Vec<[MotionState; 7]> =
            self.legs.iter().map(|(_, posture)| posture.map(MotionState::at_rest)).collect();
        match &self.passing {
            Passing::Smooth => self.pass_smoothly(&times, &mut passed),
            Passing::Straight(share) => self.pass_straight(*share, &times, &mut passed),
            Passing::Given(states) => {
                for (passed, states) in passed.iter_mut().zip(states) {
                    *passed = states.map(|state| MotionState {
                        position: state.position,
                        velocity: state.velocity / duration,
                        acceleration: state.acceleration / duration.powi(2),
                    });
                }
            }
        }
        let mut from = self.start;
        let legs = self.legs.iter().zip(passed).zip(times);
        legs.map(|((&(kind, _), end), duration)| {
            let bounce = if kind == SegmentKind::Reach { self.bounce } else { [0.0; 7] };
            let motion = SegmentMotion { start: std::mem::replace(&mut from, end), end, bounce, duration };
            Segment { kind, motion }
        })
        .collect()
    }

    /// Velocity and acceleration at the postures passed that minimise the integral of the squared jerk: those at which
    /// jerk and snap are continuous.
    fn pass_smoothly(&self, times: &[f64], passed: &mut [[MotionState; 7]]) {
        let vias = passed.len() - 1;
        if vias == 0 {
            return;
        }
        for (joint, start) in self.start.iter().enumerate() {
            let (mut matrix, mut right) = (DMatrix::zeros(2 * vias, 2 * vias), DVector::zeros(2 * vias));
            for via in 0..vias {
                let place = |index: usize| passed[index][joint].position;
                let before = via.checked_sub(1).map_or(start.position, place);
                let (t, u) = (times[via], times[via + 1]);
                let (d, e) = (place(via) - before, place(via + 1) - place(via));
                // Jerk and snap of a polynomial of fifth degree at its ends, by its boundary values.
                let mut at = |row: usize, column: Option<usize>, known: f64, factor: f64| match column {
                    Some(column) => matrix[(row, column)] += factor,
                    None => right[row] -= factor * known,
                };
                let (jerk, snap) = (2 * via, 2 * via + 1);
                let own = (Some(2 * via), Some(2 * via + 1));
                let last = match via.checked_sub(1) {
                    Some(last) => (Some(2 * last), Some(2 * last + 1)),
                    None => (None, None),
                };
                let next = if via + 1 < vias { (Some(2 * via + 2), Some(2 * via + 3)) } else { (None, None) };
                let MotionState { velocity, acceleration, .. } = *start;
                let (v0, a0) = if via == 0 { (velocity, acceleration) } else { (0.0, 0.0) };
                at(jerk, None, 1.0, 60.0 * d / t.powi(3) - 60.0 * e / u.powi(3));
                at(jerk, last.0, v0, -24.0 / t.powi(2));
                at(jerk, last.1, a0, -3.0 / t);
                at(jerk, own.0, 0.0, -36.0 / t.powi(2) + 36.0 / u.powi(2));
                at(jerk, own.1, 0.0, 9.0 / t + 9.0 / u);
                at(jerk, next.0, 0.0, 24.0 / u.powi(2));
                at(jerk, next.1, 0.0, -3.0 / u);
                at(snap, None, 1.0, 360.0 * d / t.powi(4) + 360.0 * e / u.powi(4));
                at(snap, last.0, v0, -168.0 / t.powi(3));
                at(snap, last.1, a0, -24.0 / t.powi(2));
                at(snap, own.0, 0.0, -192.0 / t.powi(3) - 192.0 / u.powi(3));
                at(snap, own.1, 0.0, 36.0 / t.powi(2) - 36.0 / u.powi(2));
                at(snap, next.0, 0.0, -168.0 / u.powi(3));
                at(snap, next.1, 0.0, 24.0 / u.powi(2));
            }
            let Some(solution) = matrix.lu().solve(&right) else { continue };
            for via in 0..vias {
                let state = &mut passed[via][joint];
                (state.velocity, state.acceleration) = (solution[2 * via], solution[2 * via + 1]);
            }
        }
    }

    fn pass_straight(&self, share: f64, times: &[f64], passed: &mut [[MotionState; 7]]) {
        for via in 0..passed.len() - 1 {
            let leaves = self.legs[via].0 == SegmentKind::Leave;
            let leg = if leaves { via } else { via + 1 };
            let from = leg.checked_sub(1).map_or(self.start, |before| passed[before]);
            let to = passed[leg];
            for joint in 0..7 {
                passed[via][joint].velocity =
                    share * (to[joint].position - from[joint].position) / times[leg];
            }
        }
    }
}

/// Length of the straight way of the joints between two postures: that of the hand, and a little for the joints.
fn length(mechanism: &Mechanism, from: &Posture, to: &Posture) -> f64 {
    let posture = |share: f64| -> Posture {
        std::array::from_fn(|joint| from[joint] + share * (to[joint] - from[joint]))
    };
    let hand = |share: f64| mechanism.arm.palm(&posture(share)) * mechanism.grasp_point();
    let places: Vec<_> = (0..=MEASURED).map(|step| hand(f64::from(step) / f64::from(MEASURED))).collect();
    let path: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    let joints: f64 = from.iter().zip(to).map(|(from, to)| (from - to).powi(2)).sum();
    path.hypot(TURNING * joints.sqrt())
}

/// The share of its time in which a movement of minimum jerk has covered this share of its way.
fn time_of_bell(covered: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let s: f64 = 0.5 * (low + high);
        let bell = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
        if bell < covered { low = s } else { high = s }
    }
    0.5 * (low + high)
}

/// Duration of a movement of which these segments are the shape, in 1 s: derivatives scale with 1/T, 1/T², 1/T³.
fn shortest(segments: &[Segment], limits: &[JointLimits; 7]) -> f64 {
    let samples = segments.iter().flat_map(|segment| segment.motion.samples());
    load(samples, limits).max(SHORTEST)
}

fn broken(segments: &[Segment], limits: &[JointLimits; 7], room: f64) -> Option<usize> {
    let limits = limits.map(|limit| JointLimits {
        velocity: room * limit.velocity,
        acceleration: room * limit.acceleration,
        jerk: room * limit.jerk,
        ..limit
    });
    segments.iter().find_map(|segment| segment.motion.broken(&limits))
}
