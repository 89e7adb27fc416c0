use crate::attempt::Attempt;
use crate::blend::Blend;
use crate::budget::Budget;
use crate::incumbent::Incumbent;
use crate::shortest_time::shortest_time;
use crate::waypoints::Waypoints;
use crate::{Goal, Plan, Problem, Refusal, Segment, SegmentKind, Target, rrt_connect, segment};
use coact_robot::{MotionState, Posture};
use nalgebra::Vector3;

/// The search for the quickest movement to one of several targets: direct movements, then a bounce, then paths through several postures.
pub(crate) struct Search<'a> {
    pub problem: &'a Problem<'a>,
    /// The posture after leaving; none when the hand does not leave first.
    pub left: Option<Posture>,
    pub budget: &'a Budget,
    pub incumbent: Incumbent,
    /// Targets for which a direct movement is clear.
    pub clear: Vec<Target>,
    /// Waypoints whose durations have been chosen already.
    pub known: Vec<Waypoints>,
}

/// How segments are joined where they cannot be joined with least jerk: ever more straightly and slowly.
const STRAIGHT: [Blend; 3] =
    [Blend::AlongStraight(1.0), Blend::AlongStraight(0.5), Blend::AlongStraight(0.0)];
/// Haste with which an arm under way is tried to turn: see [`Waypoints::haste`]. Chosen by hand.
const HASTES: [f64; 2] = [0.7, 0.5];
/// Bounces that are tried for each target. Chosen by hand: a trade-off with the time of planning.
const BOUNCES: u32 = 2;
/// Bounces that are tried where a faster movement is looked for. Chosen by hand.
const ALL_BOUNCES: u32 = 6;
/// Postures that a plan's scaling counts for in the budget: it takes about as long.
const SCALING_POSTURES: u32 = 50;
/// Clearance beyond the required one that a path through several postures has before it is smoothed, m: first the one,
/// then, where there is no such path, the other. Chosen by hand: smoothing takes some of it.
const EXTRA_CLEARANCE: [f64; 2] = [0.02, 0.004];
/// Fraction of leaving on which the hand keeps to its line. Chosen by hand: the rest may blend into the reach.
const STRAIGHT_LEAVING: f64 = 0.6;
/// Postures up to which a path is refined. A trade-off: a plan has room for [`Plan::KNOTS`] knots.
const MOST_VIAS: usize = 12;
const _: () = assert!(2 * MOST_VIAS < Plan::KNOTS);

impl<'a> Search<'a> {
    /// The first plan that is hardly to be bettered, or else the best of those to the first targets that can be come to.
    ///
    /// # Errors
    /// The constraint that binds.
    pub fn run(mut self, targets: &[Target]) -> Result<Plan, Refusal> {
        for attempt in [Self::direct, Self::through_the_middle, Self::straighter, Self::bounce] {
            for target in targets {
                attempt(&mut self, target);
                if self.is_done() {
                    return self.incumbent.result();
                }
            }
        }
        for target in targets {
            if self.incumbent.is_none() {
                self.detour(target);
            }
        }
        self.improve(targets);
        self.incumbent.result()
    }

    /// Looks for a faster movement than the one that was found: with other bounces, and to other targets.
    fn improve(&mut self, targets: &[Target]) {
        for bounce in 1..ALL_BOUNCES {
            for target in targets {
                if self.is_done() || self.incumbent.is_none() {
                    return;
                }
                if self.clear.contains(target) {
                    continue;
                }
                let attempt = self.attempt(target, &[], Blend::MinimumJerk);
                let found =
                    attempt.direct().and_then(|direct| attempt.find_bounce(&direct, bounce..bounce + 1));
                if let Ok(segments) = found {
                    self.offer(&attempt, target, &segments);
                }
            }
        }
    }

    /// Whether there is no use in looking on.
    fn is_done(&self) -> bool {
        self.budget.is_spent() || self.incumbent.is_good_after(self.budget.spent_s())
    }

    /// Where the reach begins.
    fn from(&self) -> Posture {
        self.left.unwrap_or_else(|| self.problem.start.map(|state| state.position))
    }

    /// The direct movement; of an arm under way, for which it is not clear, one that turns more tightly.
    fn direct(&mut self, target: &Target) {
        let attempt = self.attempt(target, &[], Blend::MinimumJerk);
        match attempt.direct() {
            Ok(segments) => self.offer_direct(&attempt, target, &segments),
            Err(refusal) => self.incumbent.refuse(refusal),
        }
        if self.incumbent.is_none() && !self.problem.start.iter().all(MotionState::is_at_rest) {
            self.tighter(target);
        }
    }

    fn tighter(&mut self, target: &Target) {
        for haste in HASTES {
            let mut attempt = self.attempt(target, &[], Blend::MinimumJerk);
            attempt.waypoints.haste = haste;
            if let Ok(segments) = attempt.direct()
                && attempt.check(&segments).is_ok()
            {
                self.take(&attempt, &segments, target);
                return;
            }
        }
    }

    /// The direct movement, but free in how it passes its middle.
    fn through_the_middle(&mut self, target: &Target) {
        let middle = rrt_connect::refined(&self.from(), &[], &target.before);
        self.through(target, &middle, Blend::MinimumJerk);
    }

    /// The direct movement with segments that are joined less smoothly.
    fn straighter(&mut self, target: &Target) {
        if self.left.is_none() && target.before == target.at {
            return;
        }
        for blend in STRAIGHT {
            let attempt = self.attempt(target, &[], blend);
            if let Ok(segments) = attempt.direct() {
                self.offer_direct(&attempt, target, &segments);
            }
            if self.is_done() {
                return;
            }
        }
    }

    /// The movement with a bounce.
    fn bounce(&mut self, target: &Target) {
        if self.clear.contains(target) {
            return;
        }
        for blend in [Blend::MinimumJerk].into_iter().chain(STRAIGHT) {
            let attempt = self.attempt(target, &[], blend);
            match attempt.direct().and_then(|direct| attempt.find_bounce(&direct, 0..BOUNCES)) {
                Ok(segments) => self.offer(&attempt, target, &segments),
                Err(refusal) => self.incumbent.refuse(refusal),
            }
            if self.is_done() || self.left.is_none() && target.before == target.at {
                return;
            }
        }
    }

    /// A movement along a path through several postures.
    fn detour(&mut self, target: &Target) {
        for extra in EXTRA_CLEARANCE {
            let clearance = self.problem.clearance(SegmentKind::Reach);
            let ends = [&self.from(), &target.before];
            let required = self.problem.min_clearance.path + extra;
            let Some(corners) = rrt_connect::find(&clearance, ends, required, self.budget) else { continue };
            let mut vias = corners.clone();
            let attempt = self.attempt(target, &[], Blend::MinimumJerk);
            if let Some(segments) = attempt.find_bounce_near(&vias) {
                self.offer(&attempt, target, &segments);
            }
            while !self.is_done() && vias.len() < MOST_VIAS {
                self.through(target, &vias, Blend::MinimumJerk);
                vias = rrt_connect::refined(&self.from(), &vias, &target.before);
            }
            if self.incumbent.is_none() {
                // As it was found, with a stop at every corner: not smooth, but clear.
                self.through(target, &corners, Blend::AlongStraight(0.0));
            }
        }
    }

    /// The movement through these postures.
    fn through(&mut self, target: &Target, vias: &[Posture], blend: Blend) {
        let attempt = self.attempt(target, vias, blend);
        if let Ok(segments) = attempt.direct() {
            self.offer(&attempt, target, &segments);
        }
    }

    /// Offers the segments of a direct movement, and remembers the target if they are clear.
    fn offer_direct(&mut self, attempt: &Attempt, target: &Target, segments: &[Segment]) {
        let clear = attempt.check(segments);
        if clear.is_ok() {
            self.clear.push(*target);
        }
        self.offer_checked(attempt, target, segments, clear);
    }

    fn offer(&mut self, attempt: &Attempt, target: &Target, segments: &[Segment]) {
        self.offer_checked(attempt, target, segments, attempt.check(segments));
    }

    /// Offers segments smoothed and as they are, as far as they are clear.
    fn offer_checked(
        &mut self,
        attempt: &Attempt,
        target: &Target,
        segments: &[Segment],
        clear: Result<(), Refusal>,
    ) {
        if let Some(smoother) = attempt.smooth(segments) {
            self.take(attempt, &smoother, target);
            if segments.len() == 1 && self.is_done() {
                return;
            }
        }
        match clear {
            Ok(()) => self.take(attempt, segments, target),
            Err(refusal) => self.incumbent.refuse(refusal),
        }
    }

    /// Takes clear segments as a plan, if it is better than the best so far.
    fn take(&mut self, attempt: &Attempt, segments: &[Segment], target: &Target) {
        let Problem { mechanism, goal, .. } = self.problem;
        let end = segment::states_at(segments, segment::duration(segments)).map(|state| state.position);
        let least = shortest_time(&self.problem.start, &end, &attempt.limits);
        let bounces = !self.clear.contains(target);
        let target = matches!(goal, Goal::Hand(_)).then_some(*target);
        self.budget.spend(SCALING_POSTURES);
        match attempt.plan(segments) {
            Ok(plan) => self.incumbent.offer(mechanism, Plan { target, bounces, ..plan }, least),
            Err(refusal) => self.incumbent.refuse(refusal),
        }
    }

    /// An attempt to come to a target through these postures.
    fn attempt(&mut self, target: &Target, vias: &[Posture], blend: Blend) -> Attempt<'a> {
        Attempt {
            clearance: self.problem.clearance(SegmentKind::Reach),
            limits: self.problem.mechanism.limits(),
            waypoints: self.waypoints(target, vias, blend),
            min_clearance: self.problem.min_clearance,
            hand_speeds: self.problem.hand_speeds,
            lines: [self.line_out(), self.line_in(target)],
            budget: self.budget,
        }
    }

    /// The waypoints to a target through these postures, with the smoothest durations; computed once.
    fn waypoints(&mut self, target: &Target, vias: &[Posture], blend: Blend) -> Waypoints {
        let leave = self.left.map(|left| (SegmentKind::Leave, left));
        let reaches = vias.iter().chain([&target.before]).map(|posture| (SegmentKind::Reach, *posture));
        let approach = (target.before != target.at).then_some((SegmentKind::Approach, target.at));
        let ends: Vec<_> = leave.into_iter().chain(reaches).chain(approach).collect();
        let known = self.known.iter().find(|known| known.ends == ends && known.blend == blend);
        known.cloned().unwrap_or_else(|| {
            let Problem { mechanism, start, .. } = *self.problem;
            let waypoints = Waypoints::new(mechanism, start, ends, blend);
            let waypoints = waypoints.smoothest(mechanism, &mechanism.limits());
            self.known.push(waypoints.clone());
            waypoints
        })
    }

    /// The first part of leaving, on which the hand keeps to its line, m.
    fn line_out(&self) -> Vector3<f64> {
        self.problem.leave.map_or_else(Vector3::zeros, |(out, distance)| out * distance * STRAIGHT_LEAVING)
    }

    /// The last part of the approach to a target on which it does, m, from the goal outwards.
    fn line_in(&self, target: &Target) -> Vector3<f64> {
        let goal = if let Goal::Hand(goals) = &self.problem.goal { goals.get(target.goal) } else { None };
        goal.map_or_else(Vector3::zeros, |goal| -goal.along * self.problem.insertion_depth)
    }
}
