//! How a path is followed in time: as fast as the joints' limits of speed, acceleration and jerk and those of the hand's speed allow.
//!
//! ```text
//! segments       a path, in a time of its own
//!  -> MeasuredPath, PathBounds   its length, and what the limits allow along it
//!  -> TimeOptimalScaling         the fastest scaling under limits of speed and acceleration
//!  -> its mean over a window     which bounds the jerk: of a trapezoid of speed it is the fastest movement of limited jerk (Biagiotti,
//!                                Melchiorri, Robot. Comput.-Integr. Manuf. 28, 2012)
//!  -> Plan                       knots; where a limit is broken between them, less acceleration is used there, and the scaling is made anew
//! ```

use crate::measured_path::MeasuredPath;
use crate::path_bounds::{PathBounds, STEPS};
use crate::segment::{self, Segment};
use crate::time_optimal_scaling::TimeOptimalScaling;
use crate::{HandSpeedLimits, Mechanism, Plan};
use coact_robot::{JointLimits, Knot, MotionState, Posture};

/// A path that is given a time scaling.
struct Scaled<'a> {
    segments: &'a [Segment],
    limits: &'a [JointLimits; 7],
    path: MeasuredPath<'a>,
    bounds: PathBounds<'a>,
}

/// Pieces of a plan.
const PIECES: usize = Plan::KNOTS - 1;
/// Windows that are tried, as multiples of the time in which a joint comes from rest to its limit of acceleration. Chosen by hand: hardly
/// more than that, and twice as much, for where an acceleration turns into the opposite one.
const WINDOWS: [f64; 2] = [1.2, 2.0];
/// How often a scaling is made at most, less steep each time where it breaks a limit. Chosen by hand: the last ones gain a hundredth.
const ROUNDS: u32 = 4;
/// A scaling whose knots break limits by less than this is slowed as a whole.
const NEARLY: f64 = 1.02;
/// Instants between two knots at which the plan's clearance is computed: with [`PIECES`] as many as there are points at
/// which a reach was checked.
const CHECKED: u32 = 3;
/// Halvings by which the end of a segment is found in time: to a millisecond.
const HALVINGS: u32 = 14;

/// The segments as the fastest plan. It differs a little from the segments between its knots; `keeps` says whether a posture is still clear
/// enough at this instant of the segments' own time. In that time, slowed to the hand's speeds, where the fastest is slower: a path with a
/// corner, at which the segments stop. A movement under way that no scaling slows down may be faster than the hand shall be.
///
/// `speeds` of the hand, and how far, m, from where it leaves and from where it arrives it keeps to that of contact.
///
/// # Errors
/// The joint that breaks a limit, when no scaling keeps them.
pub(crate) fn plan(
    mechanism: &Mechanism,
    segments: &[Segment],
    limits: &[JointLimits; 7],
    (speeds, near): (&HandSpeedLimits, [f64; 2]),
    keeps: &dyn Fn(f64, &Posture) -> bool,
) -> Result<Plan, usize> {
    let rises = mechanism.arm.joints.iter().map(|joint| joint.limits.acceleration / joint.limits.jerk);
    let windows = WINDOWS.map(|times| times * rises.clone().fold(0.0, f64::max));
    // The mean takes in what was half a window before.
    let near = near.map(|near| near + 0.5 * windows[1] * speeds.contact);
    let path = MeasuredPath::of(segments, limits);
    let bounds = PathBounds::of(mechanism, segments, &path, limits, (speeds, near));
    let mut scaled = Scaled { segments, limits, path, bounds };
    let shortest = scaled.shortest();
    let by_duration = |one: &Plan, other: &Plan| one.duration().total_cmp(&other.duration());
    let found = windows.iter().filter_map(|window| scaled.fastest(*window, keeps));
    let fastest = found.min_by(by_duration);
    let plan = match (fastest, scaled.in_own_time()) {
        (Some(fastest), Ok(own)) if scaled.own_time_is_slow() => std::cmp::min_by(fastest, own, by_duration),
        (Some(fastest), _) => fastest,
        (None, own) => own?,
    };
    Ok(Plan { shortest, ..plan })
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
    Plan { knots, segments: segment::ends(segments).collect(), ..Plan::default() }
}

impl Scaled<'_> {
    /// The segments in their own time, slowed to the hand's speeds if they begin at rest.
    fn in_own_time(&self) -> Result<Plan, usize> {
        let plan = in_own_time(self.segments);
        let plan = if self.is_under_way() { plan } else { plan.slower(self.bounds.slowing(&self.path)) };
        let plan = plan.below_speed_limits(self.limits)?;
        plan.broken(self.limits).map_or(Ok(plan), Err)
    }

    /// Whether the hand keeps to its speeds in the segments' own time: under way it may be faster, and nothing but a scaling slows it down.
    fn own_time_is_slow(&self) -> bool {
        !self.is_under_way() || self.bounds.slowing(&self.path) <= 1.0
    }

    /// The shortest time whatever the jerk, s.
    fn shortest(&self) -> f64 {
        let start = if self.is_under_way() { self.path.start() } else { MotionState::default() };
        TimeOptimalScaling::of(&self.bounds, start).map_or(f64::INFINITY, |scaling| scaling.duration())
    }

    fn is_under_way(&self) -> bool {
        !segment::states_at(self.segments, 0.0).iter().all(MotionState::is_at_rest)
    }

    /// The fastest plan with this window, if it keeps the limits and clear.
    fn fastest(&mut self, window: f64, keeps: &dyn Fn(f64, &Posture) -> bool) -> Option<Plan> {
        self.bounds.restore();
        let mut best: Option<(Plan, TimeOptimalScaling)> = None;
        for _ in 0..ROUNDS {
            let Some((scaling, plan)) = self.scaled(window) else { break };
            let load = plan.load(self.limits);
            if load > NEARLY {
                self.ease(&plan, &scaling, window);
            }
            let slower = self.within_limits(plan, load);
            let duration =
                |plan: &Plan| best.as_ref().is_none_or(|(best, _)| plan.duration() < best.duration());
            if let Some(plan) = slower.filter(duration) {
                best = Some((plan, scaling));
            }
            if load <= NEARLY {
                break;
            }
        }
        best.filter(|(plan, scaling)| self.is_clear(plan, scaling, window, keeps)).map(|(plan, _)| plan)
    }

    /// The time-optimal scaling as far as the joints' acceleration may be used, and the plan that its mean is.
    fn scaled(&self, window: f64) -> Option<(TimeOptimalScaling, Plan)> {
        let scaling = TimeOptimalScaling::of(&self.bounds, self.start(window))?;
        let plan = self.follow(&scaling, window)?;
        Some((scaling, plan))
    }

    /// Where the scaling begins so that its mean begins with the segments' own state: half a window later, with the acceleration of before.
    fn start(&self, window: f64) -> MotionState {
        if !self.is_under_way() {
            return MotionState::default();
        }
        let MotionState { velocity, acceleration, .. } = self.path.start();
        MotionState {
            position: velocity * window / 2.0 + acceleration * window.powi(2) / 12.0,
            velocity: (velocity + acceleration * window / 2.0).max(0.0),
            acceleration,
        }
    }

    /// The plan, slower as a whole if it must be, and if it may: a movement under way cannot.
    fn within_limits(&self, plan: Plan, load: f64) -> Option<Plan> {
        let plan = if self.is_under_way() { plan } else { plan.slower(load.max(1.0)) };
        let plan = plan.below_speed_limits(self.limits).ok()?;
        plan.broken(self.limits).is_none().then_some(plan)
    }

    /// Less acceleration where the plan breaks a limit.
    fn ease(&mut self, plan: &Plan, scaling: &TimeOptimalScaling, window: f64) {
        for pair in plan.knots.windows(2) {
            let load = Plan { knots: pair.to_vec(), ..Plan::default() }.load(self.limits);
            if load <= 1.0 {
                continue;
            }
            for point in 0..=STEPS {
                let t = scaling.time_at(point as f64 * self.bounds.step);
                if (pair[0].t - window..=pair[1].t).contains(&t) {
                    self.bounds.ease(point, load.powi(2));
                }
            }
        }
    }

    /// The plan by this scaling; none where it would leave the path.
    fn follow(&self, scaling: &TimeOptimalScaling, window: f64) -> Option<Plan> {
        let (duration, segments) = (scaling.duration() + window, self.segments);
        let mut knots = vec![Knot { t: 0.0, states: segment::states_at(segments, 0.0) }];
        for piece in 1..PIECES {
            let t = duration * piece as f64 / PIECES as f64;
            let length = scaling.mean(t - 0.5 * window, window);
            if length.velocity < 0.0 || length.position <= 0.0 || length.position >= self.path.length() {
                return None;
            }
            knots.push(Knot { t, states: self.path.states_at(length) });
        }
        knots.push(Knot { t: duration, states: segment::states_at(segments, segment::duration(segments)) });
        let ends = segment::ends(segments).map(|(kind, own)| (kind, self.time_of(own, scaling, window)));
        Some(Plan { knots, segments: ends.collect(), ..Plan::default() })
    }

    /// When the plan is where the segments are in their own time, s.
    fn time_of(&self, own: f64, scaling: &TimeOptimalScaling, window: f64) -> f64 {
        let (length, duration) = (self.path.length_at(own), scaling.duration() + window);
        if length >= self.path.length() {
            return duration;
        }
        let (mut low, mut high) = (0.0, duration);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let is_before = scaling.mean(middle - 0.5 * window, window).position < length;
            if is_before { low = middle } else { high = middle }
        }
        high
    }

    /// Whether a plan by this scaling keeps clear between its knots, too.
    fn is_clear(
        &self,
        plan: &Plan,
        scaling: &TimeOptimalScaling,
        window: f64,
        keeps: &dyn Fn(f64, &Posture) -> bool,
    ) -> bool {
        let slower = plan.duration() / (scaling.duration() + window);
        plan.instants(CHECKED).all(|t| {
            let length = scaling.mean(t / slower - 0.5 * window, window).position;
            keeps(self.path.own_time(length), &plan.at(t).map(|state| state.position))
        })
    }
}
