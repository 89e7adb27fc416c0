use crate::numerical_ik::NumericalIk;
use crate::posture_cost::{cost, time_cost};
use crate::{Clearance, Mechanism, MinClearance, Refusal, SegmentKind, Target};
use coact_robot::{HandGoal, JointLimits, Posture};
use nalgebra::Isometry3;
use std::f64::consts::TAU;

/// The search for the postures at which people would end: those to which the change of posture costs least (Rosenbaum et
/// al., Psychol. Rev. 108, 2001). A closed form gives all postures of an S-R-S arm for a swivel angle; other arms are
/// solved numerically.
pub(crate) struct TargetSearch<'a> {
    /// Clearance at the goal.
    pub clearance: Clearance<'a>,
    pub goals: &'a [HandGoal],
    /// The posture from which the change counts.
    pub from: &'a Posture,
    /// Where a grasped part goes next: see [`Problem`](crate::Problem).
    pub next_displacements: &'a [Isometry3<f64>],
    pub min_clearance: MinClearance,
    pub limits: [JointLimits; 7],
}

/// A posture at a goal that has not been checked yet.
#[derive(Clone, Copy)]
struct Candidate {
    /// Weighted squared change of posture, rad², and the time cost of it, s.
    cost: f64,
    time: f64,
    goal: usize,
    roll: f64,
    swivel: f64,
    at: Posture,
}

/// Swivel angles and rolls that are looked at: every 10 and every 30 degrees. A trade-off with the time of planning; the
/// best ones are refined.
const SWIVELS: u32 = 36;
const ROLLS: u32 = 12;
/// Distance from the joint limits that targets keep, rad: 1 degree.
const FROM_LIMITS: f64 = 0.0175;
/// Largest change of a joint between the posture before the approach and that at the goal, rad: with more, the two belong
/// to different branches of the inverse kinematics, and the hand would not go straight. Chosen by hand.
const LARGEST_CHANGE: f64 = 0.9;
/// Targets that are offered at most, of half as many again that are found, and by how much they differ at least, rad². Chosen by hand:
/// some will not have a clear path, and similar ones would fail alike.
const OFFERED: usize = 8;
const DIFFERENCE: f64 = 0.3;
/// What it costs that an approach is bent, s/m: what goes into its place must be kept on its line, and of an approach that is bent by more than
/// 2 cm that rarely becomes of it. Chosen by hand.
const BENT: f64 = 20.0;
/// The same where a part goes on to another place. Chosen by hand.
const COMPARED: usize = 24;
/// Postures at that other place that are checked at most. Chosen by hand: a bound on time.
const NEXT_CHECKED: usize = 60;
/// Candidates that are checked at most, of those that are soonest and of those of least travel. Chosen by hand: a bound on time.
const CHECKED: usize = 2000;
/// Random postures from which the numerical solver starts, besides the present one. A trade-off with the time of planning:
/// each start finds at most one of the postures.
const STARTS: u32 = 24;
/// Step of swivel and roll with which a target is refined first and last, as fractions of their grids' steps, and the gain
/// that counts, s or rad². Chosen by hand.
const FIRST_STEP: f64 = 0.5;
const LAST_STEP: f64 = 0.02;
const LEAST_GAIN: f64 = 1e-6;
/// Candidates that are looked at for the reason of a refusal. Chosen by hand: a bound on time.
const EXPLAINED: usize = 200;

impl TargetSearch<'_> {
    /// The best targets, which differ from each other; first those to which the arm is soonest, and comes straight. Where a part goes on to another place, those come
    /// first from which the hand can go on, by the time of both changes of posture.
    ///
    /// # Errors
    /// The constraint that binds, when there is none.
    pub fn best(&self) -> Result<Vec<Target>, Refusal> {
        let mut candidates = self.candidates();
        let mut offered = Vec::new();
        let most = if self.next_displacements.is_empty() { OFFERED } else { COMPARED };
        self.offer(&mut candidates, |candidate| candidate.time, most / 2, &mut offered);
        self.offer(&mut candidates, |candidate| candidate.cost, most + most / 2, &mut offered);
        let goes_on = !self.next_displacements.is_empty();
        let next = |target: &Target| if goes_on { self.time_to_next(&target.at) } else { 0.0 };
        let time = |target: &Target| target.cost + next(target) + BENT * self.bend(target);
        let mut timed: Vec<_> = offered.into_iter().map(|target| (time(&target), target)).collect();
        timed.sort_by(|one, other| one.0.total_cmp(&other.0));
        if timed.first().is_some_and(|(time, _)| time.is_finite()) {
            timed.retain(|(time, _)| time.is_finite());
        }
        let offered: Vec<_> = timed.into_iter().map(|(_, target)| target).take(OFFERED).collect();
        if offered.is_empty() { Err(self.refusal(&candidates)) } else { Ok(offered) }
    }

    /// The targets of least weighted change of posture, which differ from each other, nearest first.
    pub fn nearest(&self) -> Vec<Target> {
        let mut offered = Vec::new();
        self.offer(&mut self.candidates(), |candidate| candidate.cost, OFFERED, &mut offered);
        offered
    }

    /// How far the hand would be off the straight line in the middle of the approach, were each joint to move evenly, m.
    fn bend(&self, target: &Target) -> f64 {
        let Target { before, at, .. } = target;
        let middle = std::array::from_fn(|joint| 0.5 * (before[joint] + at[joint]));
        let [from, middle, to] = [before, &middle, at]
            .map(|posture| (self.mechanism().arm.palm(posture) * self.mechanism().grasp_point()).coords);
        (middle - 0.5 * (from + to)).norm()
    }

    /// Adds candidates that serve, those of least `cost` first, until so many are offered.
    fn offer(
        &self,
        candidates: &mut [Candidate],
        cost_of: fn(&Candidate) -> f64,
        most: usize,
        offered: &mut Vec<Target>,
    ) {
        candidates.sort_by(|one, other| cost_of(one).total_cmp(&cost_of(other)));
        for candidate in candidates.iter().take(CHECKED) {
            if offered.len() == most {
                return;
            }
            let differs = |known: &Target| cost(&known.at, &candidate.at) > DIFFERENCE;
            if offered.iter().all(differs)
                && let Some(target) = self.check(candidate)
            {
                offered.push(self.refine(target, candidate, cost_of));
            }
        }
    }

    /// An unchecked posture.
    fn candidate(&self, goal: usize, roll: f64, swivel: f64, at: Posture) -> Candidate {
        let (cost, time) = (cost(&at, self.from), time_cost(&at, self.from, &self.limits));
        Candidate { cost, time, goal, roll, swivel, at }
    }

    fn mechanism(&self) -> &Mechanism {
        self.clearance.mechanism
    }

    fn candidates(&self) -> Vec<Candidate> {
        let mut found = Vec::new();
        for (goal, wanted) in self.goals.iter().enumerate() {
            let rolls = if wanted.rolls == 0 { ROLLS } else { wanted.rolls.min(ROLLS) };
            for roll in (0..rolls).map(|step| angle(step, rolls)) {
                for swivel in (0..SWIVELS).map(|step| angle(step, SWIVELS)) {
                    found.extend(self.postures(goal, roll, swivel));
                }
                if self.mechanism().closed_form.is_some() {
                    continue;
                }
                found.extend(self.solved(goal, roll));
                if wanted.rolls == 0 {
                    break;
                }
            }
        }
        found
    }

    /// Postures of the closed form, where there is one.
    fn postures(&self, goal: usize, roll: f64, swivel: f64) -> impl Iterator<Item = Candidate> + use<'_> {
        let palm = self.mechanism().palm_at(&self.goals[goal], roll, 0.0);
        let solutions =
            self.mechanism().closed_form.as_ref().map(|srs| srs.solve(&palm, swivel, FROM_LIMITS));
        let postures = solutions.map(|branches| branches.as_slice().to_vec()).unwrap_or_default();
        postures.into_iter().map(move |at| self.candidate(goal, roll, swivel, at))
    }

    /// Postures of the numerical solver, from several places.
    fn solved(&self, goal: usize, roll: f64) -> impl Iterator<Item = Candidate> + use<'_> {
        let solver = NumericalIk {
            clearance: self.clearance,
            from: self.from,
            min_clearance: self.min_clearance.goal,
        };
        let starts = solver.starts(STARTS);
        starts.into_iter().filter_map(move |start| {
            let at = solver.solve(&self.goals[goal], roll, 0.0, &start)?;
            Some(self.candidate(goal, roll, 0.0, at))
        })
    }

    /// The target that a candidate stands for, if it and the posture before it are clear.
    fn check(&self, candidate: &Candidate) -> Option<Target> {
        let Candidate { time: cost, goal, roll, at, .. } = *candidate;
        let back = self.goals[goal].back;
        if !self.clearance.is_clear(&at, self.min_clearance.goal) {
            return None;
        }
        let before = if back > 0.0 { self.before(candidate)? } else { at };
        let on_reach = self.clearance.at(SegmentKind::Reach);
        on_reach.is_clear(&before, self.min_clearance.path).then_some(Target { goal, roll, before, at, cost })
    }

    /// The posture from which the approach begins: that nearest to the goal's.
    fn before(&self, candidate: &Candidate) -> Option<Posture> {
        let (goal, at) = (&self.goals[candidate.goal], &candidate.at);
        let Some(srs) = &self.mechanism().closed_form else {
            let solver =
                NumericalIk { clearance: self.clearance, from: at, min_clearance: self.min_clearance.path };
            let before = solver.solve(goal, candidate.roll, goal.back, at)?;
            return (largest_change(&before, at) <= LARGEST_CHANGE).then_some(before);
        };
        let palm = self.mechanism().palm_at(goal, candidate.roll, goal.back);
        let branches = srs.solve(&palm, candidate.swivel, FROM_LIMITS);
        let near = branches.as_slice().iter().filter(|before| largest_change(before, at) <= LARGEST_CHANGE);
        near.min_by(|one, other| cost(one, at).total_cmp(&cost(other, at))).copied()
    }

    /// Time cost of the change of posture to where the hand is next, s; infinite when it cannot go on from this posture.
    fn time_to_next(&self, at: &Posture) -> f64 {
        let palm = self.mechanism().arm.palm(at);
        let mut next: Vec<Posture> = self
            .next_displacements
            .iter()
            .flat_map(|displacement| self.postures_at(&(displacement * palm), at))
            .collect();
        next.sort_by(|one, other| cost(one, at).total_cmp(&cost(other, at)));
        let clear = next
            .iter()
            .take(NEXT_CHECKED)
            .find(|next| self.clearance.is_clear(next, self.min_clearance.goal));
        clear.map_or(f64::INFINITY, |next| time_cost(next, at, &self.limits))
    }

    /// Postures with the palm there, found from another posture.
    fn postures_at(&self, palm: &Isometry3<f64>, from: &Posture) -> Vec<Posture> {
        if let Some(srs) = &self.mechanism().closed_form {
            let branches = (0..SWIVELS).map(|step| srs.solve(palm, angle(step, SWIVELS), FROM_LIMITS));
            return branches.flat_map(|branches| branches.as_slice().to_vec()).collect();
        }
        let solver = NumericalIk { clearance: self.clearance, from, min_clearance: self.min_clearance.goal };
        let goal = self.mechanism().goal_of(palm);
        solver.starts(STARTS).iter().filter_map(|start| solver.solve(&goal, 0.0, 0.0, start)).collect()
    }

    /// Looks for a cheaper target around a candidate, in ever smaller steps of swivel and roll.
    fn refine(&self, mut best: Target, candidate: &Candidate, cost_of: fn(&Candidate) -> f64) -> Target {
        if self.mechanism().closed_form.is_none() {
            return best;
        }
        let turns = self.goals[best.goal].rolls == 0;
        let (mut swivel, mut step, mut least) = (candidate.swivel, FIRST_STEP, cost_of(candidate));
        while step > LAST_STEP {
            let around = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
            let moved = around.iter().filter(|(_, roll)| turns || *roll == 0.0).find_map(|(one, other)| {
                let roll = best.roll + other * step * TAU / f64::from(ROLLS);
                let swivel = swivel + one * step * TAU / f64::from(SWIVELS);
                let cheaper = self
                    .postures(best.goal, roll, swivel)
                    .filter(|found| cost_of(found) < least - LEAST_GAIN);
                cheaper.filter_map(|found| Some((self.check(&found)?, swivel, cost_of(&found)))).next()
            });
            match moved {
                Some(found) => (best, swivel, least) = found,
                None => step *= 0.5,
            }
        }
        best
    }

    /// Why there is no target.
    fn refusal(&self, candidates: &[Candidate]) -> Refusal {
        let mut least: Option<(f64, String, String)> = None;
        for candidate in candidates.iter().step_by(candidates.len() / EXPLAINED + 1) {
            let near = |posture: &Posture, segment: SegmentKind, required: f64| {
                let clearance = self.clearance.at(segment);
                Some((clearance.nearest(posture, required)?, required, clearance))
            };
            let at = near(&candidate.at, SegmentKind::Approach, self.min_clearance.goal);
            let before = || near(&self.before(candidate)?, SegmentKind::Reach, self.min_clearance.path);
            let Some((near, required, clearance)) = at.or_else(before) else { continue };
            let short = required - near.distance;
            if least.as_ref().is_none_or(|(known, ..)| short < *known) {
                let (link, other) = clearance.names(&near);
                least = Some((short, link, other));
            }
        }
        match least {
            Some((short, link, other)) => Refusal::Blocked { link, other, short },
            None => self.limit_that_binds(),
        }
    }

    fn limit_that_binds(&self) -> Refusal {
        let point = self.goals.first().map_or([0.0; 3], |goal| goal.point.coords.into());
        let Some(srs) = &self.mechanism().closed_form else { return Refusal::OutOfReach { point } };
        let mut least: Option<(f64, usize)> = None;
        for goal in self.goals {
            for step in 0..ROLLS * SWIVELS {
                let roll = angle(step / SWIVELS, ROLLS);
                let at = self.mechanism().palm_at(goal, roll, 0.0);
                for posture in srs.solve(&at, angle(step % SWIVELS, SWIVELS), -TAU).as_slice() {
                    let worst = self.mechanism().worst_excess(posture);
                    if least.is_none_or(|(known, _)| worst.0 < known) {
                        least = Some(worst);
                    }
                }
            }
        }
        match least {
            Some((excess, joint)) => {
                Refusal::JointLimit { joint: self.mechanism().arm.joints[joint].name.clone(), excess }
            }
            None => Refusal::OutOfReach { point },
        }
    }
}

impl Mechanism {
    /// How far the worst joint of a posture lies beyond its limits, rad, and which that is.
    fn worst_excess(&self, posture: &Posture) -> (f64, usize) {
        let excess = |(joint, angle): (&coact_robot::Joint, &f64)| {
            (joint.limits.lower - angle).max(angle - joint.limits.upper)
        };
        let joints = self.arm.joints.iter().zip(posture).map(excess).zip(0..);
        joints.max_by(|one, other| one.0.total_cmp(&other.0)).unwrap_or((0.0, 0))
    }
}

fn angle(step: u32, count: u32) -> f64 {
    TAU * f64::from(step) / f64::from(count)
}

fn largest_change(a: &Posture, b: &Posture) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
