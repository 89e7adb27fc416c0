use crate::route::{Passing, Route};
use crate::solver::Solver;
use crate::target::{Target, TargetSearch};
use crate::way::Way;
use crate::{Body, Clearance, Mechanism, Plan, Refusal, Scene, Stage, StageKind, bell, detour};
use coact_robot::{HandGoal, MotionState, Posture};
use nalgebra::Vector3;

/// A movement that is asked for.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    /// Who moves.
    pub mechanism: &'a Mechanism,
    /// Arm, hand and what it holds.
    pub body: &'a Body,
    /// The surroundings; what the hand may touch may be touched on leaving and at the goal only.
    pub scene: &'a Scene,
    /// State of the arm's joints now.
    pub start: [MotionState; 7],
    /// First straight back by this much: direction (unit, world) and distance, m.
    pub leave: Option<(Vector3<f64>, f64)>,
    /// Where to.
    pub aim: Aim,
    /// What is kept clear.
    pub margin: Margin,
}

/// Where a movement shall end.
#[derive(Debug, Clone, PartialEq)]
pub enum Aim {
    /// At whichever of these goals is most comfortable.
    Hand(Vec<HandGoal>),
    /// At this posture, rad.
    Posture(Posture),
}

/// Distances that are kept, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margin {
    /// On the way.
    pub way: f64,
    /// Where the hand leaves, approaches and is at its goal.
    pub goal: f64,
}

impl Margin {
    /// At a share of the way: towards both ends it narrows to that of leaving and approaching, m.
    pub(crate) fn at(&self, share: f64) -> f64 {
        let from_end = share.min(1.0 - share).max(0.0);
        self.goal + (self.way - self.goal) * (from_end / NARROWING).min(1.0)
    }
}

impl Default for Margin {
    fn default() -> Self {
        Self { way: 0.01, goal: 0.003 }
    }
}

/// Share of a way in which the margin narrows.
const NARROWING: f64 = 0.2;
/// How stages are joined: as smoothly as possible, else ever more straightly and slowly.
const PASSINGS: [Passing; 4] =
    [Passing::Smooth, Passing::Straight(1.0), Passing::Straight(0.5), Passing::Straight(0.0)];
/// Targets for which all kinds of ways are tried before the next ones.
const AT_ONCE: usize = 2;
/// Excursions that are tried for each target.
const TRIES: u32 = 2;
/// Distance beyond the margin that a way through several postures keeps before it is made smooth, m: first, then.
const ROOM: [f64; 2] = [0.02, 0.004];
/// How often a way through several postures is made to follow the one that was found more closely.
const DENSER: u32 = 4;

impl Problem<'_> {
    /// Plans the movement: targets first, the most comfortable one whose way is free.
    ///
    /// # Errors
    /// The constraint that binds.
    pub fn plan(&self) -> Result<Plan, Refusal> {
        let away = self.away()?;
        let from = away.unwrap_or_else(|| self.start.map(|state| state.position));
        let targets = self.targets(&from)?;
        let mut refusal = None;
        for few in targets.chunks(AT_ONCE) {
            for search in [Self::bounce, Self::detour] {
                for target in few {
                    match search(self, away.as_ref(), target) {
                        Ok(stages) => {
                            let target = matches!(self.aim, Aim::Hand(_)).then_some(*target);
                            return Ok(Plan { target, ..bell::timed(self.mechanism, &stages) });
                        }
                        Err(found) => _ = refusal.get_or_insert(found),
                    }
                }
            }
        }
        Err(refusal.unwrap_or(Refusal::OutOfReach { point: [0.0; 3] }))
    }

    /// The postures that serve as an end, best first; none when there are none. `from`: the posture from which the way
    /// of the joints counts.
    pub fn targets_from(&self, from: &Posture) -> Vec<Target> {
        self.targets(from).unwrap_or_default()
    }

    /// Distances where nothing may be touched.
    fn clearance(&self) -> Clearance<'_> {
        Clearance { mechanism: self.mechanism, body: self.body, scene: self.scene, touching: false }
    }

    /// Distances where the hand may touch what it is about.
    fn touching(&self) -> Clearance<'_> {
        Clearance { touching: true, ..self.clearance() }
    }

    /// The posture after leaving; none when the hand is not to leave first.
    fn away(&self) -> Result<Option<Posture>, Refusal> {
        let posture = self.start.map(|state| state.position);
        if let Some(near) = self.touching().nearest(&posture, 0.0) {
            let (bone, other) = self.touching().names(&near);
            return Err(Refusal::Start { bone, other, short: -near.distance });
        }
        let Some((direction, distance)) = self.leave else { return Ok(None) };
        let palm = self.mechanism.arm.palm(&posture);
        let goal = HandGoal {
            point: palm * self.mechanism.grasp_point() + direction * distance,
            approach: palm.rotation * Vector3::z(),
            closing: palm.rotation * Vector3::x(),
            rolls: 1,
            back: 0.0,
            floor: f64::NEG_INFINITY,
        };
        let solver = Solver { clearance: self.touching(), from: &posture, margin: 0.0 };
        let away = solver.reach(&goal, 0.0, 0.0, &posture);
        away.map(Some).ok_or(Refusal::OutOfReach { point: goal.point.coords.into() })
    }

    fn targets(&self, from: &Posture) -> Result<Vec<Target>, Refusal> {
        match &self.aim {
            Aim::Posture(at) => Ok(vec![Target { goal: 0, roll: 0.0, before: *at, at: *at, cost: 0.0 }]),
            Aim::Hand(goals) => {
                let margin = [self.margin.way, self.margin.goal];
                let (clearance, touching) = (self.clearance(), self.touching());
                TargetSearch { clearance, touching, goals, from, margin }.best()
            }
        }
    }

    /// The direct movement to a target, or the one with a single excursion.
    fn bounce(&self, away: Option<&Posture>, target: &Target) -> Result<Vec<Stage>, Refusal> {
        let mut refusal = None;
        for passing in PASSINGS {
            match self.way(away, target, &[], passing).find() {
                Ok(stages) => return Ok(stages),
                Err(found) => _ = refusal.get_or_insert(found),
            }
            if away.is_none() && target.before == target.at {
                break;
            }
        }
        Err(refusal.unwrap_or(Refusal::OutOfReach { point: [0.0; 3] }))
    }

    /// A movement to a target through several postures.
    fn detour(&self, away: Option<&Posture>, target: &Target) -> Result<Vec<Stage>, Refusal> {
        let from = away.copied().unwrap_or_else(|| self.start.map(|state| state.position));
        let mut refusal = Refusal::OutOfReach { point: [0.0; 3] };
        for room in ROOM {
            let found = detour::find(&self.clearance(), &from, &target.before, self.margin.way + room);
            let Some(mut vias) = found else { continue };
            let single = self.way(away, target, &[], Passing::Smooth);
            if let Some(stages) = vias.iter().find_map(|via| single.find_near(via)) {
                return Ok(stages);
            }
            for _ in 0..DENSER {
                match self.way(away, target, &vias, Passing::Smooth).follow() {
                    Ok(stages) => return Ok(stages),
                    Err(found) => refusal = found,
                }
                vias = detour::denser(&from, &vias, &target.before);
            }
        }
        Err(refusal)
    }

    /// The way to a target through these postures.
    fn way(&self, away: Option<&Posture>, target: &Target, vias: &[Posture], passing: Passing) -> Way<'_> {
        let limits = self.mechanism.limits();
        let leave = away.map(|away| (StageKind::Leave, *away));
        let reaches = vias.iter().chain([&target.before]).map(|posture| (StageKind::Reach, *posture));
        let approach = (target.before != target.at).then_some((StageKind::Approach, target.at));
        let legs = leave.into_iter().chain(reaches).chain(approach).collect();
        let route = Route::new(self.mechanism, self.start, legs, passing).smoothest(self.mechanism, &limits);
        let (clearance, touching) = (self.clearance(), self.touching());
        Way { clearance, touching, limits, route, margin: self.margin, tries: TRIES }
    }
}
