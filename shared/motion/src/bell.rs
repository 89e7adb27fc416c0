//! The law of time of a movement: the hand's speed rises and falls once, like a bell.

use crate::roughness::Roughness;
use crate::{Knot, Mechanism, Plan, Segment, SegmentKind};
use coact_robot::{JointLimits, MotionState, Posture, Quintic};

/// Points at which the way of the segments is measured.
const MEASURED: usize = 240;
/// Pieces of a plan.
const PIECES: usize = 24;
/// What a change of the joints counts for in the length of the way, m/rad. The less it counts the more the law of time
/// is that of the hand; the more it counts the less the joints must hurry where the hand only turns.
const TURNINGS: [f64; 3] = [0.08, 0.02, 0.005];
/// How much longer than in the segments' own time a movement may take for the sake of one bell, and in which steps one
/// under way is slowed down until it keeps the limits.
const LONGER: f64 = 4.5;
const SLOWER: f64 = 1.04;
/// Instants between two knots at which a plan is held against the obstacles again.
const CHECKED: u32 = 4;

/// The segments as a plan: in their own time or, where the hand moves more smoothly so, in one in which the length of the
/// way, from hand and joints, grows as in a movement of minimum jerk. That way is a little different between the knots;
/// `keeps` says whether a posture is still clear enough at this instant of the segments' own time.
pub(crate) fn timed(
    mechanism: &Mechanism,
    segments: &[Segment],
    limits: &[JointLimits; 7],
    keeps: &dyn Fn(f64, &Posture) -> bool,
) -> (Roughness, Plan) {
    let way = Way::measure(mechanism, segments);
    let laws: Vec<Law> = TURNINGS.iter().map(|turning| Law::new(&way, *turning)).collect();
    let rough = |plan: &Plan| Roughness::of(mechanism, plan, MEASURED);
    let mut best = sampled(segments);
    let mut roughness = rough(&best);
    for law in &laws {
        let Some(plan) = law.fastest(limits) else { continue };
        let found = rough(&plan);
        if found < roughness && law.keeps(&plan, keeps) {
            (best, roughness) = (plan, found);
        }
    }
    (roughness, best)
}

/// The segments in their own time.
pub(crate) fn sampled(segments: &[Segment]) -> Plan {
    let total = total(segments);
    let most = (Plan::KNOTS - 1).saturating_sub(segments.len()) as f64;
    let mut knots = vec![Knot { t: 0.0, states: at(segments, 0.0) }];
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
    Plan { knots, segments: ends(segments).collect(), bounces: false, target: None }
}

/// The way of segments, measured at equal steps of the segments' own time.
struct Way<'a> {
    segments: &'a [Segment],
    step: f64,
    /// Speeds of the hand, m/s, and of all joints together, rad/s.
    speeds: Vec<(f64, f64)>,
}

impl<'a> Way<'a> {
    fn measure(mechanism: &Mechanism, segments: &'a [Segment]) -> Self {
        let step = total(segments) / MEASURED as f64;
        let hand = |t: f64| {
            mechanism.arm.palm(&at(segments, t).map(|state| state.position)) * mechanism.grasp_point()
        };
        let places: Vec<_> = (0..=2 * MEASURED).map(|half| hand(0.5 * step * half as f64)).collect();
        let speeds = (0..=MEASURED).map(|point| {
            let (before, after) = ((2 * point).max(1) - 1, (2 * point + 1).min(2 * MEASURED));
            let hand = (places[after] - places[before]).norm() / (0.5 * step * (after - before) as f64);
            let joints = at(segments, point as f64 * step).map(|state| state.velocity.powi(2));
            (hand, joints.iter().sum::<f64>().sqrt())
        });
        Self { segments, step, speeds: speeds.collect() }
    }
}

/// A law of time on a way: how its length is covered.
struct Law<'a> {
    way: &'a Way<'a>,
    /// Length so far, m.
    covered: Vec<f64>,
    /// Its derivative by the segments' own time, m/s.
    speed: Vec<f64>,
}

impl<'a> Law<'a> {
    /// With this length for a change of the joints, m/rad.
    fn new(way: &'a Way, turning: f64) -> Self {
        let speed: Vec<f64> = way.speeds.iter().map(|(hand, joints)| hand.hypot(turning * joints)).collect();
        let mut covered = vec![0.0];
        for pair in speed.windows(2) {
            covered.push(covered[covered.len() - 1] + 0.5 * way.step * (pair[0] + pair[1]));
        }
        Self { way, covered, speed }
    }

    /// The fastest plan with a bell that keeps the limits.
    fn fastest(&self, limits: &[JointLimits; 7]) -> Option<Plan> {
        let total = total(self.way.segments);
        if at(self.way.segments, 0.0).iter().all(MotionState::is_at_rest) {
            let plan = self.follow(total)?;
            let load = plan.load(limits);
            let slower = plan.slower(load);
            return (slower.duration() < LONGER * total && slower.broken(limits).is_none()).then_some(slower);
        }
        let durations = std::iter::successors(Some(0.6 * total), |duration| Some(SLOWER * duration));
        let plans = durations.take_while(|duration| *duration < LONGER * total).map(|time| self.follow(time));
        plans.flatten().find(|plan| plan.broken(limits).is_none())
    }

    /// The length at each instant of a movement of this duration.
    fn bell(&self, duration: f64) -> Quintic {
        let slope = (self.speed[1] - self.speed[0]) / self.way.step;
        let acceleration = if self.speed[0] < 1e-6 { 0.0 } else { slope };
        let start = MotionState { position: 0.0, velocity: self.speed[0], acceleration };
        Quintic::new(start, MotionState::at_rest(self.covered[MEASURED]), duration)
    }

    /// The segments' own time at which this length is covered, and the speed then with its derivative.
    fn time(&self, length: f64) -> (f64, f64, f64) {
        let to = self.covered.partition_point(|covered| *covered < length).clamp(1, MEASURED);
        let from = to - 1;
        let share = (length - self.covered[from]) / (self.covered[to] - self.covered[from]).max(1e-12);
        let step = self.way.step;
        let slope = (self.speed[to] - self.speed[from]) / step;
        ((from as f64 + share) * step, self.speed[from] + share * step * slope, slope)
    }

    /// The way in this duration; none where it would have to go back.
    fn follow(&self, duration: f64) -> Option<Plan> {
        let (segments, law) = (self.way.segments, self.bell(duration));
        let mut knots = vec![Knot { t: 0.0, states: at(segments, 0.0) }];
        for piece in 1..PIECES {
            let t = duration * piece as f64 / PIECES as f64;
            let MotionState { position, velocity, acceleration } = law.at(t);
            if velocity < 0.0 || position <= 0.0 || position >= self.covered[MEASURED] {
                return None;
            }
            let (own, speed, slope) = self.time(position);
            let rate = velocity / speed.max(1e-9);
            let change = (acceleration - slope * rate * rate) / speed.max(1e-9);
            let states = at(segments, own).map(|state| MotionState {
                position: state.position,
                velocity: state.velocity * rate,
                acceleration: state.acceleration * rate * rate + state.velocity * change,
            });
            knots.push(Knot { t, states });
        }
        knots.push(Knot { t: duration, states: at(segments, total(segments)) });
        let passed = |own: f64| {
            let point = ((own / self.way.step).round() as usize).min(MEASURED);
            knots.iter().find(|knot| law.at(knot.t).position >= self.covered[point] - 1e-9)
        };
        let ends = ends(segments).map(|(kind, own)| (kind, passed(own).map_or(duration, |knot| knot.t)));
        let segments = ends.collect();
        Some(Plan { knots, segments, bounces: false, target: None })
    }

    /// Whether a plan that follows this law keeps clear between the knots, too.
    fn keeps(&self, plan: &Plan, keeps: &dyn Fn(f64, &Posture) -> bool) -> bool {
        let law = self.bell(plan.duration());
        plan.instants(CHECKED).all(|t| {
            let (own, ..) = self.time(law.at(t).position);
            keeps(own, &plan.at(t).map(|state| state.position))
        })
    }
}

/// When each segment ends, in the segments' own time.
fn ends(segments: &[Segment]) -> impl Iterator<Item = (SegmentKind, f64)> {
    segments.iter().scan(0.0, |end, segment| {
        *end += segment.motion.duration;
        Some((segment.kind, *end))
    })
}

fn total(segments: &[Segment]) -> f64 {
    segments.iter().map(|segment| segment.motion.duration).sum()
}

/// State `t` s after the start of the first segment.
fn at(segments: &[Segment], t: f64) -> [MotionState; 7] {
    during(segments, t).map_or([MotionState::default(); 7], |(segment, t)| segment.motion.at(t))
}

/// The segment under way `t` s after the start of the first one, and the time since its own start, s.
pub(crate) fn during(segments: &[Segment], mut t: f64) -> Option<(&Segment, f64)> {
    for segment in segments {
        if t < segment.motion.duration {
            return Some((segment, t));
        }
        t -= segment.motion.duration;
    }
    segments.last().map(|segment| (segment, segment.motion.duration))
}
