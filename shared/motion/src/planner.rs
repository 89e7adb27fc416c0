use crate::choice::Choice;
use crate::search::Search;
use crate::solver::Solver;
use crate::target::{Target, TargetSearch};
use crate::work::Work;
use crate::{Clearance, CollisionModel, Mechanism, Plan, Refusal, Scene, SegmentKind};
use coact_robot::{HandGoal, MotionState, Posture};
use nalgebra::{Isometry3, Translation3, Vector3};

/// A movement that is asked for.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    /// Who moves.
    pub mechanism: &'a Mechanism,
    /// Arm, hand and what it holds.
    pub collision_model: &'a CollisionModel,
    /// The surroundings; what the hand may touch may be touched on leaving and at the goal only.
    pub scene: &'a Scene,
    /// State of the arm's joints now.
    pub start: [MotionState; 7],
    /// First straight back by this much: direction (unit, world) and distance, m.
    pub leave: Option<(Vector3<f64>, f64)>,
    /// Where the movement ends.
    pub goal: Goal,
    /// Where a grasped part goes next: the displacement (world) from its place now to each place that serves; a round part
    /// may be turned about its own axis at will. Goals from which the hand can carry out one of them are preferred.
    pub next_displacements: Vec<Isometry3<f64>>,
    /// Length of the last part of the approach on which the hand keeps to a straight line, m: as deep as a part goes
    /// into something.
    pub insertion_depth: f64,
    /// Distances that are kept.
    pub min_clearance: MinClearance,
}

/// Where a movement shall end.
#[derive(Debug, Clone, PartialEq)]
pub enum Goal {
    /// At whichever of these goals is most comfortable.
    Hand(Vec<HandGoal>),
    /// At this posture, rad.
    Posture(Posture),
}

/// Distances that are kept, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MinClearance {
    /// On the reach.
    pub path: f64,
    /// Where the hand leaves, approaches and is at its goal.
    pub goal: f64,
}

impl MinClearance {
    /// At a fraction of the reach: towards both ends it narrows to that of leaving and approaching, m.
    pub(crate) fn at(&self, fraction: f64) -> f64 {
        let from_end = fraction.min(1.0 - fraction).max(0.0);
        self.goal + (self.path - self.goal) * (from_end / NARROWING).min(1.0)
    }
}

impl Default for MinClearance {
    fn default() -> Self {
        Self { path: 0.01, goal: 0.003 }
    }
}

/// Postures that a search for a way may look at: less than a second's work at a laid table.
const WORK: u32 = 40_000;
/// Share of a way in which the margin narrows.
const NARROWING: f64 = 0.2;

impl Problem<'_> {
    /// Plans the movement: targets first, the most comfortable one whose way is free.
    ///
    /// # Errors
    /// The constraint that binds.
    pub fn plan(&self) -> Result<Plan, Refusal> {
        self.plan_within(WORK)
    }

    /// The same for somebody who waits: the search ends after `postures` postures, 40 000 of which take about a second.
    ///
    /// # Errors
    /// The constraint that binds, as far as the search came.
    pub fn plan_within(&self, postures: u32) -> Result<Plan, Refusal> {
        let away = self.away()?;
        let from = away.unwrap_or_else(|| self.start.map(|state| state.position));
        let targets = self.targets(&from)?;
        let work = Work::of(postures);
        Search { problem: self, away, work: &work, choice: Choice::default(), routes: Vec::new() }
            .run(&targets)
    }

    /// The postures that serve as an end, best first; none when there are none. `from`: the posture from which the way
    /// of the joints counts.
    pub fn targets_from(&self, from: &Posture) -> Vec<Target> {
        self.targets(from).unwrap_or_default()
    }

    /// Distances at a segment of the movement.
    pub(crate) fn clearance(&self, segment: SegmentKind) -> Clearance<'_> {
        Clearance {
            mechanism: self.mechanism,
            collision_model: self.collision_model,
            scene: self.scene,
            segment,
        }
    }

    /// The posture after leaving; none when the hand is not to leave first.
    fn away(&self) -> Result<Option<Posture>, Refusal> {
        let posture = self.start.map(|state| state.position);
        let clearance = self.clearance(SegmentKind::Leave);
        if let Some(near) = clearance.nearest(&posture, 0.0) {
            let (link, other) = clearance.names(&near);
            return Err(Refusal::Start { link, other, short: -near.distance });
        }
        let Some((direction, distance)) = self.leave else { return Ok(None) };
        let palm = self.mechanism.arm.palm(&posture);
        let goal = self.mechanism.goal_of(&(Translation3::from(direction * distance) * palm));
        let solver = Solver { clearance, from: &posture, margin: 0.0 };
        let away = solver.reach(&goal, 0.0, 0.0, &posture);
        away.map(Some).ok_or(Refusal::OutOfReach { point: goal.point.coords.into() })
    }

    fn targets(&self, from: &Posture) -> Result<Vec<Target>, Refusal> {
        match &self.goal {
            Goal::Posture(at) => Ok(vec![Target { goal: 0, roll: 0.0, before: *at, at: *at, cost: 0.0 }]),
            Goal::Hand(goals) => {
                let margin = [self.min_clearance.path, self.min_clearance.goal];
                let clearance = self.clearance(SegmentKind::Approach);
                TargetSearch { clearance, goals, from, next_displacements: &self.next_displacements, margin }
                    .best()
            }
        }
    }
}
