use crate::choice::Choice;
use crate::route::{Passing, Route};
use crate::way::Way;
use crate::work::Work;
use crate::{Goal, Plan, Problem, Refusal, Segment, SegmentKind, Target, detour};
use coact_robot::Posture;
use nalgebra::Vector3;

/// The search for a movement to one of several targets on which the hand moves in one unit.
pub(crate) struct Search<'a> {
    pub problem: &'a Problem<'a>,
    /// The posture after leaving.
    pub away: Option<Posture>,
    /// What it may do.
    pub work: &'a Work,
    pub choice: Choice,
    /// Routes that were looked at.
    pub routes: Vec<Route>,
}

/// How segments are joined where they cannot be joined smoothly: ever more straightly and slowly.
const STRAIGHT: [Passing; 3] = [Passing::Straight(1.0), Passing::Straight(0.5), Passing::Straight(0.0)];
/// Targets for which all kinds of ways are tried before the next ones.
const AT_ONCE: usize = 2;
/// Excursions that are tried for each target.
const TRIES: u32 = 2;
/// And as many more for each where no movement in one unit was found.
const MORE: u32 = 8;
/// Distance beyond the margin that a way through several postures keeps before it is made smooth, m: first, then.
const ROOM: [f64; 2] = [0.02, 0.004];
/// Share of leaving that is straight.
const LEAVING: f64 = 0.6;
/// Postures that a way passes at most.
const MOST_VIAS: usize = 12;

impl<'a> Search<'a> {
    /// The first movement in one unit, or else the smoothest one.
    ///
    /// # Errors
    /// The constraint that binds.
    pub fn run(mut self, targets: &[Target]) -> Result<Plan, Refusal> {
        let kinds: [fn(&mut Self, &Target); 4] =
            [Self::direct, Self::through_the_middle, Self::straighter, Self::bounce];
        for few in targets.chunks(AT_ONCE) {
            for target in few {
                for offer in kinds {
                    offer(&mut self, target);
                    if self.choice.is_smooth() {
                        return self.choice.result();
                    }
                }
            }
            for target in few {
                if self.choice.is_open() {
                    self.detour(target);
                }
            }
            if self.choice.is_smooth() || self.work.is_done() {
                break;
            }
        }
        if !self.choice.is_open() {
            self.go_on(targets);
        }
        self.choice.result()
    }

    /// Looks for a movement in one unit where there is one in more: other excursions, and ways through several postures.
    fn go_on(&mut self, targets: &[Target]) {
        for target in targets.iter().take(AT_ONCE) {
            if self.choice.is_smooth() || self.work.is_done() {
                return;
            }
            self.detour(target);
        }
        for attempt in TRIES..TRIES + MORE {
            for target in targets {
                if self.choice.is_smooth() || self.work.is_done() {
                    return;
                }
                let way = self.way(target, &[], Passing::Smooth);
                let found = way.direct().and_then(|direct| way.find(&direct, attempt..attempt + 1));
                if let Ok(segments) = found {
                    self.offer(&way, target, &segments, true);
                }
            }
        }
    }

    /// Where the reach begins.
    fn from(&self) -> Posture {
        self.away.unwrap_or_else(|| self.problem.start.map(|state| state.position))
    }

    /// The direct movement.
    fn direct(&mut self, target: &Target) {
        let way = self.way(target, &[], Passing::Smooth);
        match way.direct() {
            Ok(segments) => self.offer(&way, target, &segments, false),
            Err(refusal) => self.choice.refuse(refusal),
        }
    }

    /// The direct movement, but free in how it passes its middle.
    fn through_the_middle(&mut self, target: &Target) {
        self.follow(target, &detour::denser(&self.from(), &[], &target.before), Passing::Smooth);
    }

    /// The direct movement with segments joined less smoothly.
    fn straighter(&mut self, target: &Target) {
        if self.away.is_none() && target.before == target.at {
            return;
        }
        for passing in STRAIGHT {
            let way = self.way(target, &[], passing);
            if let Ok(segments) = way.direct() {
                self.offer(&way, target, &segments, false);
            }
            if self.choice.is_smooth() {
                return;
            }
        }
    }

    /// The movement with a single excursion.
    fn bounce(&mut self, target: &Target) {
        for passing in [Passing::Smooth].into_iter().chain(STRAIGHT) {
            let way = self.way(target, &[], passing);
            match way.direct().and_then(|direct| way.find(&direct, 0..TRIES)) {
                Ok(segments) => self.offer(&way, target, &segments, true),
                Err(refusal) => self.choice.refuse(refusal),
            }
            if self.choice.is_smooth() || self.away.is_none() && target.before == target.at {
                return;
            }
        }
    }

    /// A movement through several postures.
    fn detour(&mut self, target: &Target) {
        for room in ROOM {
            let margin = self.problem.min_clearance.path + room;
            let found = detour::find(
                &self.problem.clearance(SegmentKind::Reach),
                [&self.from(), &target.before],
                margin,
                self.work,
            );
            let Some(corners) = found else { continue };
            let mut vias = corners.clone();
            let way = self.way(target, &[], Passing::Smooth);
            if let Some(segments) = way.find_near(&vias) {
                self.offer(&way, target, &segments, true);
            }
            while !self.choice.is_smooth() && vias.len() < MOST_VIAS {
                self.follow(target, &vias, Passing::Smooth);
                vias = detour::denser(&self.from(), &vias, &target.before);
            }
            if self.choice.is_open() {
                // As it was found, with a rest at every corner: not beautiful, but clear.
                self.follow(target, &corners, Passing::Straight(0.0));
            }
        }
    }

    /// The movement through these postures.
    fn follow(&mut self, target: &Target, vias: &[Posture], passing: Passing) {
        let way = self.way(target, vias, passing);
        if let Ok(segments) = way.direct() {
            self.offer(&way, target, &segments, true);
        }
    }

    /// Offers segments more smoothly than they are and as they are, as far as they are clear.
    fn offer(&mut self, way: &Way, target: &Target, segments: &[Segment], bounces: bool) {
        let target = matches!(self.problem.goal, Goal::Hand(_)).then_some(*target);
        let clear = way.check(segments);
        let bounces = bounces || clear.is_err();
        if let Some(smoother) = way.smooth(segments) {
            self.choice.offer(way.plan(&smoother), target, bounces);
            if segments.len() == 1 && self.choice.is_smooth() {
                return;
            }
        }
        match clear {
            Ok(()) => self.choice.offer(way.plan(segments), target, bounces),
            Err(refusal) => self.choice.refuse(refusal),
        }
    }

    /// The way to a target through these postures.
    fn way(&mut self, target: &Target, vias: &[Posture], passing: Passing) -> Way<'a> {
        Way {
            clearance: self.problem.clearance(SegmentKind::Reach),
            limits: self.problem.mechanism.limits(),
            route: self.route(target, vias, passing),
            min_clearance: self.problem.min_clearance,
            lines: [self.line_out(), self.line_in(target)],
            work: self.work,
        }
    }

    /// The smoothest route to a target through these postures, looked for once.
    fn route(&mut self, target: &Target, vias: &[Posture], passing: Passing) -> Route {
        let leave = self.away.map(|away| (SegmentKind::Leave, away));
        let reaches = vias.iter().chain([&target.before]).map(|posture| (SegmentKind::Reach, *posture));
        let approach = (target.before != target.at).then_some((SegmentKind::Approach, target.at));
        let legs: Vec<_> = leave.into_iter().chain(reaches).chain(approach).collect();
        let known = self.routes.iter().find(|route| route.legs == legs && route.passing == passing);
        known.cloned().unwrap_or_else(|| {
            let Problem { mechanism, start, .. } = *self.problem;
            let route = Route::new(mechanism, start, legs, passing);
            let route = route.smoothest(mechanism, &mechanism.limits());
            self.routes.push(route.clone());
            route
        })
    }

    /// The first part of leaving, on which the hand keeps to its line, m.
    fn line_out(&self) -> Vector3<f64> {
        self.problem.leave.map_or_else(Vector3::zeros, |(out, distance)| out * distance * LEAVING)
    }

    /// The last part of the approach to a target on which it does, m, from the goal outwards.
    fn line_in(&self, target: &Target) -> Vector3<f64> {
        let goal = if let Goal::Hand(goals) = &self.problem.goal { goals.get(target.goal) } else { None };
        goal.map_or_else(Vector3::zeros, |goal| -goal.along * self.problem.insertion_depth)
    }
}
