use crate::measured_path::{MEASURED, MeasuredPath};
use crate::roughness::Roughness;
use crate::segment::{self, Segment};
use crate::{Mechanism, Plan};
use coact_robot::{JointLimits, Knot, MotionState, Posture, Quintic};

/// A time scaling of a path (Lynch, Park, *Modern Robotics*, ch. 9): the length that is covered grows with time as in a
/// minimum-jerk movement (Flash, Hogan, J. Neurosci. 5, 1985), so that the speed rises and falls once.
struct TimeScaling<'a> {
    path: &'a MeasuredPath<'a>,
    /// Length of the path up to each of its points, m.
    covered: Vec<f64>,
    /// Its derivative by the segments' own time, m/s.
    speed: Vec<f64>,
}

/// Pieces of a time-scaled plan. A trade-off: at most [`Plan::KNOTS`] - 1; fewer follow the path less closely.
const PIECES: usize = 24;
const _: () = assert!(PIECES < Plan::KNOTS);
/// What a change of the joints counts for in the length of a path, m/rad. The less it counts the more the hand's speed
/// alone is a single rise and fall; the more it counts the less the joints must hurry where the hand only turns. All of
/// these are tried and the smoothest plan is taken. Chosen by hand, a factor of four apart.
const JOINT_LENGTHS: [f64; 3] = [0.08, 0.02, 0.005];
/// How many times as long as the segments' own time a plan may take for the sake of a single rise and fall of speed.
/// Chosen by hand: a trade-off between a smooth and a short movement.
const LONGEST: f64 = 4.5;
/// Where the search for the shortest duration of a movement under way begins, in the segments' own time, and the factor
/// from one trial to the next. Chosen by hand: the duration found is at most 4 % too long.
const UNDER_WAY: (f64, f64) = (0.6, 1.04);
/// Instants between two knots at which the plan's clearance is computed: with [`PIECES`] as many as there are points at
/// which a reach was checked.
const CHECKED: u32 = 4;
/// Lengths (m) and speeds (m/s) below these count as zero: they only guard divisions.
const TINY_LENGTH: f64 = 1e-12;
const TINY_SPEED: f64 = 1e-9;
/// A path whose speed at the start is below this begins at rest, m/s.
const AT_REST: f64 = 1e-6;
/// Rounding of a covered length that still counts as the end of a segment, m.
const ROUNDING: f64 = 1e-9;

/// The segments as a plan: in their own time or, where the hand moves more smoothly so, time-scaled. A time-scaled plan
/// differs a little from the segments between its knots; `keeps` says whether a posture is still clear enough at this
/// instant of the segments' own time.
pub(crate) fn plan(
    mechanism: &Mechanism,
    segments: &[Segment],
    limits: &[JointLimits; 7],
    keeps: &dyn Fn(f64, &Posture) -> bool,
) -> (Roughness, Plan) {
    let path = MeasuredPath::of(mechanism, segments);
    let scalings: Vec<_> = JOINT_LENGTHS.iter().map(|length| TimeScaling::new(&path, *length)).collect();
    let roughness_of = |plan: &Plan| Roughness::of(mechanism, plan, MEASURED);
    let mut best = in_own_time(segments);
    let mut roughness = roughness_of(&best);
    for scaling in &scalings {
        let Some(plan) = scaling.fastest(limits) else { continue };
        let found = roughness_of(&plan);
        if found < roughness && scaling.keeps(&plan, keeps) {
            (best, roughness) = (plan, found);
        }
    }
    (roughness, best)
}

/// The segments in their own time.
pub(crate) fn in_own_time(segments: &[Segment]) -> Plan {
    let total = segment::duration(segments);
    let most = (Plan::KNOTS - 1).saturating_sub(segments.len()) as f64;
    let mut knots = vec![Knot { t: 0.0, states: segment::states_at(segments, 0.0) }];
    let mut before = 0.0;
    for Segment { motion, .. } in segments {
        let pieces = (most * motion.duration / total).ceil();
        let pieces = if motion.bounces() { pieces } else { 1.0 };
        for piece in 1..=pieces as u32 {
            let t = motion.duration * f64::from(piece) / pieces;
            knots.push(Knot { t: before + t, states: motion.at(t) });
        }
        before += motion.duration;
    }
    Plan { knots, segments: segment::ends(segments).collect(), bounces: false, target: None }
}

impl<'a> TimeScaling<'a> {
    /// With `joint_length` m for each rad of the joints' change.
    fn new(path: &'a MeasuredPath, joint_length: f64) -> Self {
        let speed: Vec<f64> =
            path.speeds.iter().map(|(hand, joints)| hand.hypot(joint_length * joints)).collect();
        let mut covered = vec![0.0];
        for pair in speed.windows(2) {
            covered.push(covered[covered.len() - 1] + 0.5 * path.step * (pair[0] + pair[1]));
        }
        Self { path, covered, speed }
    }

    /// The fastest plan that keeps the limits.
    fn fastest(&self, limits: &[JointLimits; 7]) -> Option<Plan> {
        let total = segment::duration(self.path.segments);
        if segment::states_at(self.path.segments, 0.0).iter().all(MotionState::is_at_rest) {
            let plan = self.follow(total)?;
            let load = plan.load(limits);
            let slower = plan.slower(load);
            return (slower.duration() < LONGEST * total && slower.broken(limits).is_none())
                .then_some(slower);
        }
        let (first, factor) = UNDER_WAY;
        let durations = std::iter::successors(Some(first * total), |duration| Some(factor * duration));
        let plans =
            durations.take_while(|duration| *duration < LONGEST * total).map(|time| self.follow(time));
        plans.flatten().find(|plan| plan.broken(limits).is_none())
    }

    /// The length covered at each instant of a movement of this duration.
    fn covered_at(&self, duration: f64) -> Quintic {
        let change = (self.speed[1] - self.speed[0]) / self.path.step;
        let acceleration = if self.speed[0] < AT_REST { 0.0 } else { change };
        let start = MotionState { position: 0.0, velocity: self.speed[0], acceleration };
        Quintic::new(start, MotionState::at_rest(self.covered[MEASURED]), duration)
    }

    /// The segments' own time at which this length is covered, and the speed then with its derivative.
    fn own_time(&self, length: f64) -> (f64, f64, f64) {
        let to = self.covered.partition_point(|covered| *covered < length).clamp(1, MEASURED);
        let from = to - 1;
        let fraction =
            (length - self.covered[from]) / (self.covered[to] - self.covered[from]).max(TINY_LENGTH);
        let step = self.path.step;
        let change = (self.speed[to] - self.speed[from]) / step;
        ((from as f64 + fraction) * step, self.speed[from] + fraction * step * change, change)
    }

    /// The path in this duration; none where it would have to be followed backwards.
    fn follow(&self, duration: f64) -> Option<Plan> {
        let (segments, covered) = (self.path.segments, self.covered_at(duration));
        let mut knots = vec![Knot { t: 0.0, states: segment::states_at(segments, 0.0) }];
        for piece in 1..PIECES {
            let t = duration * piece as f64 / PIECES as f64;
            let length = covered.at(t);
            if length.velocity < 0.0 || length.position <= 0.0 || length.position >= self.covered[MEASURED] {
                return None;
            }
            knots.push(Knot { t, states: self.states_at(length) });
        }
        let end = segment::states_at(segments, segment::duration(segments));
        knots.push(Knot { t: duration, states: end });
        let passed = |own: f64| {
            let point = ((own / self.path.step).round() as usize).min(MEASURED);
            knots.iter().find(|knot| covered.at(knot.t).position >= self.covered[point] - ROUNDING)
        };
        let ends = segment::ends(segments);
        let ends = ends.map(|(kind, own)| (kind, passed(own).map_or(duration, |knot| knot.t))).collect();
        Some(Plan { knots, segments: ends, bounces: false, target: None })
    }

    /// States of all joints where the path is covered so far and so fast: the chain rule.
    fn states_at(&self, length: MotionState) -> [MotionState; 7] {
        let (own, speed, speed_change) = self.own_time(length.position);
        let rate = length.velocity / speed.max(TINY_SPEED);
        let rate_change = (length.acceleration - speed_change * rate * rate) / speed.max(TINY_SPEED);
        segment::states_at(self.path.segments, own).map(|state| MotionState {
            position: state.position,
            velocity: state.velocity * rate,
            acceleration: state.acceleration * rate * rate + state.velocity * rate_change,
        })
    }

    /// Whether a plan of this time scaling keeps clear between its knots, too.
    fn keeps(&self, plan: &Plan, keeps: &dyn Fn(f64, &Posture) -> bool) -> bool {
        let covered = self.covered_at(plan.duration());
        plan.instants(CHECKED).all(|t| {
            let (own, ..) = self.own_time(covered.at(t).position);
            keeps(own, &plan.at(t).map(|state| state.position))
        })
    }
}
