//! The law of time of a movement: the hand's speed rises and falls once, like a bell.

use crate::{HandPath, Knot, Mechanism, Plan, Stage};
use coact_robot::{MotionState, Quintic};

/// Points at which the way of the stages is measured.
const MEASURED: usize = 240;
/// Pieces of a plan.
const PIECES: usize = 32;
/// What a change of the joints counts for in the length of the way, m/rad: it matters where the hand only turns.
const TURNING: f64 = 0.08;
/// How much longer than in the stages' own time a movement may take for the sake of one bell, and in which steps it is
/// slowed down until it keeps the limits.
const LONGER: f64 = 3.0;
const SLOWER: f64 = 1.04;

/// The stages as a plan. Where the hand would speed up more than once, the way gets another law of time: its length,
/// from hand and joints, grows as in a movement of minimum jerk. Where that takes too long the stages keep their own.
pub(crate) fn timed(mechanism: &Mechanism, stages: &[Stage]) -> Plan {
    let total: f64 = stages.iter().map(|stage| stage.trajectory.duration).sum();
    let mut best = sampled(stages);
    let path = HandPath::of(mechanism, &best, MEASURED);
    if path.units() == 1 {
        return best;
    }
    let way = Way::measure(mechanism, stages, total);
    let limits = mechanism.limits();
    let start = MotionState { position: 0.0, velocity: way.speed[0], acceleration: way.acceleration() };
    let mut duration = 0.6 * total;
    while duration < LONGER * total {
        let law = Quintic::new(start, MotionState::at_rest(way.length()), duration);
        if let Some(plan) = way.follow(&law, duration).filter(|plan| plan.broken(&limits).is_none()) {
            if HandPath::of(mechanism, &plan, MEASURED).units() < path.units() {
                best = plan;
            }
            break;
        }
        duration *= SLOWER;
    }
    best
}

/// The stages in their own time.
pub(crate) fn sampled(stages: &[Stage]) -> Plan {
    let total: f64 = stages.iter().map(|stage| stage.trajectory.duration).sum();
    let mut knots = vec![Knot { t: 0.0, states: at(stages, 0.0) }];
    let mut before = 0.0;
    for Stage { trajectory, .. } in stages {
        let pieces = (PIECES as f64 * trajectory.duration / total).ceil();
        let pieces = if trajectory.bounces() { pieces } else { 1.0 };
        for piece in 1..=pieces as u32 {
            let t = trajectory.duration * f64::from(piece) / pieces;
            knots.push(Knot { t: before + t, states: trajectory.at(t) });
        }
        before += trajectory.duration;
    }
    Plan { knots, stages: ends(stages), bounces: bounces(stages), target: None }
}

/// The way of stages, measured at equal steps of the stages' own time.
struct Way<'a> {
    stages: &'a [Stage],
    step: f64,
    /// Length so far, m.
    covered: Vec<f64>,
    /// Its derivative, m/s.
    speed: Vec<f64>,
}

impl<'a> Way<'a> {
    fn measure(mechanism: &Mechanism, stages: &'a [Stage], total: f64) -> Self {
        let step = total / MEASURED as f64;
        let hand =
            |t: f64| mechanism.arm.palm(&at(stages, t).map(|state| state.position)) * mechanism.grasp_point();
        let places: Vec<_> = (0..=2 * MEASURED).map(|half| hand(0.5 * step * half as f64)).collect();
        let speed: Vec<f64> = (0..=MEASURED)
            .map(|point| {
                let (before, after) = ((2 * point).max(1) - 1, (2 * point + 1).min(2 * MEASURED));
                let hand = (places[after] - places[before]).norm() / (0.5 * step * (after - before) as f64);
                let joints: f64 =
                    at(stages, point as f64 * step).iter().map(|state| state.velocity.powi(2)).sum();
                hand.hypot(TURNING * joints.sqrt())
            })
            .collect();
        let mut covered = vec![0.0];
        for pair in speed.windows(2) {
            covered.push(covered[covered.len() - 1] + 0.5 * step * (pair[0] + pair[1]));
        }
        Self { stages, step, covered, speed }
    }

    fn length(&self) -> f64 {
        self.covered[MEASURED]
    }

    /// Second derivative of the length at the start, m/s².
    fn acceleration(&self) -> f64 {
        if self.speed[0] < 1e-6 { 0.0 } else { (self.speed[1] - self.speed[0]) / self.step }
    }

    /// The stages' own time at which this length is covered, and the speed then with its derivative.
    fn time(&self, length: f64) -> (f64, f64, f64) {
        let to = self.covered.partition_point(|covered| *covered < length).clamp(1, MEASURED);
        let from = to - 1;
        let share = (length - self.covered[from]) / (self.covered[to] - self.covered[from]).max(1e-12);
        let slope = (self.speed[to] - self.speed[from]) / self.step;
        ((from as f64 + share) * self.step, self.speed[from] + share * self.step * slope, slope)
    }

    /// The way in the time of `law`; none where it would have to go back.
    fn follow(&self, law: &Quintic, duration: f64) -> Option<Plan> {
        let mut knots = vec![Knot { t: 0.0, states: at(self.stages, 0.0) }];
        for piece in 1..PIECES {
            let t = duration * piece as f64 / PIECES as f64;
            let MotionState { position, velocity, acceleration } = law.at(t);
            if velocity < 0.0 || position <= 0.0 || position >= self.length() {
                return None;
            }
            let (own, speed, slope) = self.time(position);
            let rate = velocity / speed.max(1e-9);
            let change = (acceleration - slope * rate * rate) / speed.max(1e-9);
            let states = at(self.stages, own).map(|state| MotionState {
                position: state.position,
                velocity: state.velocity * rate,
                acceleration: state.acceleration * rate * rate + state.velocity * change,
            });
            knots.push(Knot { t, states });
        }
        knots.push(Knot { t: duration, states: at(self.stages, self.step * MEASURED as f64) });
        let stages = ends(self.stages).into_iter().map(|(kind, end)| {
            let point = ((end / self.step).round() as usize).min(MEASURED);
            let passed = knots.iter().find(|knot| law.at(knot.t).position >= self.covered[point] - 1e-9);
            (kind, passed.map_or(duration, |knot| knot.t))
        });
        let stages = stages.collect();
        Some(Plan { knots, stages, bounces: bounces(self.stages), target: None })
    }
}

/// When each stage ends, in the stages' own time.
fn ends(stages: &[Stage]) -> Vec<(crate::StageKind, f64)> {
    let ends = stages.iter().scan(0.0, |end, stage| {
        *end += stage.trajectory.duration;
        Some((stage.kind, *end))
    });
    ends.collect()
}

fn bounces(stages: &[Stage]) -> bool {
    stages.iter().any(|stage| stage.trajectory.bounces())
}

/// State `t` s after the start of the first stage.
fn at(stages: &[Stage], mut t: f64) -> [MotionState; 7] {
    for (index, stage) in stages.iter().enumerate() {
        if t < stage.trajectory.duration || index + 1 == stages.len() {
            return stage.trajectory.at(t);
        }
        t -= stage.trajectory.duration;
    }
    [MotionState::default(); 7]
}
