use crate::blend::Blend;
use crate::plan::load;
use crate::{
    HandPath, Mechanism, Plan, Segment, SegmentKind, SegmentMotion, minimum_jerk_spline, time_scaling,
};
use coact_robot::{JointLimits, MotionState, Posture};

/// The postures that a movement passes, how it passes them, and which fraction of its duration lies between them: all of
/// a movement but its duration.
#[derive(Debug, Clone)]
pub(crate) struct Waypoints {
    /// State at the start.
    pub start: [MotionState; 7],
    /// The kind of each segment, and the posture at its end.
    pub ends: Vec<(SegmentKind, Posture)>,
    /// Weight of each segment's duration; the duration's fraction is the weight over the sum of all.
    pub weights: Vec<f64>,
    /// How the postures between segments are passed.
    pub blend: Blend,
    /// Bounce of the reach, rad: see [`SegmentMotion`].
    pub bounce: Posture,
    /// Fraction of the shortest duration within the limits that a movement under way takes in its own time. The less, the tighter it turns;
    /// below 1 only a time scaling that slows it down in the turn keeps the limits.
    pub haste: f64,
}

/// What a change of the joints counts for in the length of a segment, m/rad: it matters where the hand only turns.
/// Chosen by hand: a trade-off between a smooth speed of the hand and hurried joints.
const JOINT_LENGTH: f64 = 0.05;
/// Pieces in which the hand's path along a segment is measured. Chosen by hand.
const MEASURED: u32 = 8;
/// Places of the hand by which two choices of durations are compared. A trade-off with the time of planning.
const SAMPLED: usize = 80;
/// Factors of the duration of leaving and of approaching that are tried for the smoothest movement. Chosen by hand:
/// steps of 25 % to half and to double.
const DURATION_FACTORS: [f64; 6] = [0.8, 0.64, 0.5, 1.25, 1.6, 2.0];
/// Smallest weight of a segment: it only guards divisions, where a segment has no length.
const LEAST_WEIGHT: f64 = 1e-3;
/// Smallest length of all segments together, m: it only guards a division.
const TINY_LENGTH: f64 = 1e-9;
/// Shortest movement, s: it keeps the duration above zero where start and end coincide. Chosen by hand, far below the one
/// to two seconds of a reach.
const SHORTEST_S: f64 = 0.1;
/// A movement under way is made longer by this factor until it keeps the limits, so many times at most: up to ten times
/// as long. The factor makes a movement at most 4 % too long.
const LONGER: f64 = 1.04;
const LONGER_TRIES: u32 = 60;
/// Rounding of velocity, acceleration and jerk that is allowed to a movement from rest. Its duration was computed from
/// their limits, so that what is left to be checked are the limits of position. A movement from motion keeps as much below them: what its
/// knots make of it between them goes beyond it by less.
const ROUNDING: f64 = 1e-3;
/// Halvings of an interval of 1 when the minimum-jerk profile is inverted: to 1e-12.
const HALVINGS: u32 = 40;

impl Waypoints {
    /// Waypoints whose segments take the time in which a hand with a minimum-jerk profile of speed would cover them.
    pub fn new(
        mechanism: &Mechanism,
        start: [MotionState; 7],
        ends: Vec<(SegmentKind, Posture)>,
        blend: Blend,
    ) -> Self {
        let from = start.map(|state| state.position);
        let postures = ends.iter().map(|(_, posture)| *posture);
        let lengths: Vec<f64> = std::iter::once(from)
            .chain(postures.clone())
            .zip(postures)
            .map(|(from, to)| length(mechanism, &from, &to))
            .collect();
        let total: f64 = lengths.iter().sum();
        let passed = lengths.iter().scan(0.0, |covered, length| {
            *covered += length / total.max(TINY_LENGTH);
            Some(time_at(*covered))
        });
        let passed: Vec<f64> = passed.collect();
        let weights = (0..ends.len()).map(|segment| {
            let before = segment.checked_sub(1).map_or(0.0, |before| passed[before]);
            let after = if segment + 1 == ends.len() { 1.0 } else { passed[segment] };
            (after - before).max(LEAST_WEIGHT)
        });
        Self { start, weights: weights.collect(), ends, blend, bounce: [0.0; 7], haste: 1.0 }
    }

    /// The same waypoints with the durations for which the hand moves most smoothly.
    pub fn smoothest(mut self, mechanism: &Mechanism, limits: &[JointLimits; 7]) -> Self {
        let mut best = self.roughness(mechanism, limits);
        for segment in 0..self.ends.len() {
            if self.ends[segment].0 == SegmentKind::Reach {
                continue;
            }
            let weight = self.weights[segment];
            let mut chosen = weight;
            for factor in DURATION_FACTORS {
                self.weights[segment] = factor * weight;
                let roughness = self.roughness(mechanism, limits);
                if roughness < best {
                    (best, chosen) = (roughness, self.weights[segment]);
                }
            }
            self.weights[segment] = chosen;
        }
        self
    }

    /// How far the hand's movement is from a single smooth rise and fall of speed.
    fn roughness(&self, mechanism: &Mechanism, limits: &[JointLimits; 7]) -> f64 {
        self.timed(limits).map_or(f64::INFINITY, |segments| {
            let path = HandPath::of(mechanism, &time_scaling::in_own_time(&segments), SAMPLED);
            path.normalised_jerk() * f64::from(path.units())
        })
    }

    /// The shortest movement through the waypoints within the limits.
    ///
    /// # Errors
    /// The joint that breaks a limit however long the movement takes.
    pub fn timed(&self, limits: &[JointLimits; 7]) -> Result<Vec<Segment>, usize> {
        let resting =
            Self { start: self.start.map(|state| MotionState::at_rest(state.position)), ..self.clone() };
        let mut duration = shortest(&resting.segments(1.0), limits);
        if self.start.iter().all(MotionState::is_at_rest) {
            let segments = self.segments(duration);
            return broken(&segments, limits, 1.0 + ROUNDING).map_or(Ok(segments), Err);
        }
        let limits = limits.map(|limit| JointLimits { velocity: Plan::FASTEST * limit.velocity, ..limit });
        let mut joint = 0;
        for _ in 0..LONGER_TRIES {
            let segments = self.segments(duration);
            match broken(&segments, &limits, 1.0 - ROUNDING) {
                None if self.haste < 1.0 => return Ok(self.segments(self.haste * duration)),
                None => return Ok(segments),
                Some(broken) => joint = broken,
            }
            duration *= LONGER;
        }
        Err(joint)
    }

    /// The segments of a movement of this duration, s.
    fn segments(&self, duration: f64) -> Vec<Segment> {
        let total: f64 = self.weights.iter().sum();
        let times: Vec<f64> = self.weights.iter().map(|weight| weight / total * duration).collect();
        let passed = self.passed(duration, &times);
        let mut from = self.start;
        let ends = self.ends.iter().zip(passed).zip(times);
        ends.map(|((&(kind, _), end), duration)| {
            let bounce = if kind == SegmentKind::Reach { self.bounce } else { [0.0; 7] };
            let motion = SegmentMotion { start: std::mem::replace(&mut from, end), end, bounce, duration };
            Segment { kind, motion }
        })
        .collect()
    }

    /// States at the end of each segment of a movement of this duration, s; `times`: duration of each segment, s.
    fn passed(&self, duration: f64, times: &[f64]) -> Vec<[MotionState; 7]> {
        let mut passed: Vec<[MotionState; 7]> =
            self.ends.iter().map(|(_, posture)| posture.map(MotionState::at_rest)).collect();
        match &self.blend {
            Blend::MinimumJerk => self.blend_with_minimum_jerk(times, &mut passed),
            Blend::AlongStraight(fraction) => self.blend_along_straight(*fraction, times, &mut passed),
            Blend::Given(states) => {
                for (passed, states) in passed.iter_mut().zip(states) {
                    *passed = states.map(|state| MotionState {
                        position: state.position,
                        velocity: state.velocity / duration,
                        acceleration: state.acceleration / duration.powi(2),
                    });
                }
            }
        }
        passed
    }

    fn blend_with_minimum_jerk(&self, times: &[f64], passed: &mut [[MotionState; 7]]) {
        if passed.len() == 1 {
            return;
        }
        for (joint, start) in self.start.iter().enumerate() {
            let positions: Vec<f64> = passed.iter().map(|states| states[joint].position).collect();
            let found = minimum_jerk_spline::derivatives(start, &positions, times);
            for (states, [velocity, acceleration]) in passed.iter_mut().zip(found.into_iter().flatten()) {
                (states[joint].velocity, states[joint].acceleration) = (velocity, acceleration);
            }
        }
    }

    fn blend_along_straight(&self, fraction: f64, times: &[f64], passed: &mut [[MotionState; 7]]) {
        for waypoint in 0..passed.len() - 1 {
            let leaves = self.ends[waypoint].0 == SegmentKind::Leave;
            let straight = if leaves { waypoint } else { waypoint + 1 };
            let from = straight.checked_sub(1).map_or(self.start, |before| passed[before]);
            let to = passed[straight];
            for joint in 0..7 {
                passed[waypoint][joint].velocity =
                    fraction * (to[joint].position - from[joint].position) / times[straight];
            }
        }
    }
}

/// Length of the straight line of the joints between two postures, m: that of the hand's path, and a little for the
/// joints.
fn length(mechanism: &Mechanism, from: &Posture, to: &Posture) -> f64 {
    let posture = |fraction: f64| -> Posture {
        std::array::from_fn(|joint| from[joint] + fraction * (to[joint] - from[joint]))
    };
    let hand = |fraction: f64| mechanism.arm.palm(&posture(fraction)) * mechanism.grasp_point();
    let places: Vec<_> = (0..=MEASURED).map(|step| hand(f64::from(step) / f64::from(MEASURED))).collect();
    let path: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    let joints: f64 = from.iter().zip(to).map(|(from, to)| (from - to).powi(2)).sum();
    path.hypot(JOINT_LENGTH * joints.sqrt())
}

/// The fraction of its duration in which a minimum-jerk movement has covered this fraction of its length.
fn time_at(covered: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let s: f64 = 0.5 * (low + high);
        let minimum_jerk = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
        if minimum_jerk < covered { low = s } else { high = s }
    }
    0.5 * (low + high)
}

/// Duration of a movement of which these segments are the shape, in 1 s: derivatives scale with 1/T, 1/T², 1/T³.
fn shortest(segments: &[Segment], limits: &[JointLimits; 7]) -> f64 {
    let samples = segments.iter().flat_map(|segment| segment.motion.samples());
    load(samples, limits).max(SHORTEST_S)
}

/// The first joint that breaks `factor` times a limit.
fn broken(segments: &[Segment], limits: &[JointLimits; 7], factor: f64) -> Option<usize> {
    let limits = limits.map(|limit| JointLimits {
        velocity: factor * limit.velocity,
        acceleration: factor * limit.acceleration,
        jerk: factor * limit.jerk,
        ..limit
    });
    segments.iter().find_map(|segment| segment.motion.broken(&limits))
}
