use crate::budget::Budget;
use crate::incumbent::Incumbent;
use crate::numerical_ik::NumericalIk;
use crate::search::Search;
use crate::target_search::TargetSearch;
use crate::{
    Clearance, CollisionModel, Goal, HandSpeedLimits, Mechanism, MinClearance, Plan, Refusal, Scene,
    SegmentKind, Target,
};
use coact_robot::{HandGoal, MotionState, Posture};
use nalgebra::{Isometry3, Translation3, Vector3};

/// A movement that is asked for.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    /// The arm.
    pub mechanism: &'a Mechanism,
    /// The forms of arm, hand and what it holds.
    pub collision_model: &'a CollisionModel,
    /// The surroundings; what the hand may touch may be touched on leaving and at the goal only.
    pub scene: &'a Scene,
    /// State of the arm's joints now.
    pub start: [MotionState; 7],
    /// Straight back first: direction (unit, world) and distance, m.
    pub leave: Option<Leave>,
    /// Where the movement ends.
    pub goal: Goal,
    /// Where a grasped part goes next: the displacement (world) from its place now to each place that serves; a round part
    /// may be turned about its own axis at will. Goals from which the hand can carry out one of them are preferred.
    pub next_displacements: Vec<Isometry3<f64>>,
    /// Length of the last part of the approach on which the hand keeps to a straight line, m: as deep as a part goes
    /// into something.
    pub insertion_depth: f64,
    /// Clearance that is kept.
    pub min_clearance: MinClearance,
    /// How fast the hand may go.
    pub hand_speeds: HandSpeedLimits,
}

/// A direction, unit, world, and a distance, m.
type Leave = (Vector3<f64>, f64);

/// Fractions of the distance that the hand leaves straight, tried one after the other. Chosen by hand: the
/// farther, the less the reach must keep clear of what the hand has let go.
const LEAVING: [f64; 4] = [1.0, 0.7, 0.5, 0.35];
/// Postures that a search may look at. A trade-off: so many take about a second at a laid table, and a search that has not
/// found a path by then rarely finds one.
const POSTURES: u32 = 40_000;

impl<'a> Problem<'a> {
    /// A movement to this goal that does not leave straight first, puts nothing into anything, and after which nothing
    /// follows; with the usual clearance.
    pub fn new(
        mechanism: &'a Mechanism,
        collision_model: &'a CollisionModel,
        scene: &'a Scene,
        start: [MotionState; 7],
        goal: Goal,
    ) -> Self {
        Self {
            mechanism,
            collision_model,
            scene,
            start,
            leave: None,
            goal,
            next_displacements: Vec::new(),
            insertion_depth: 0.0,
            min_clearance: MinClearance::default(),
            hand_speeds: HandSpeedLimits::default(),
        }
    }

    /// Plans the movement: the postures at the goal first, then a clear path to the one that costs the least change.
    ///
    /// # Errors
    /// The constraint that binds.
    pub fn plan(&self) -> Result<Plan, Refusal> {
        self.plan_within(POSTURES)
    }

    /// Plans the movement in bounded time: the search ends after it has looked at `postures` postures, 40 000 of which take
    /// about a second.
    ///
    /// # Errors
    /// The constraint that binds, as far as the search came.
    pub fn plan_within(&self, postures: u32) -> Result<Plan, Refusal> {
        let (leave, left) = self.left()?.unzip();
        let problem = &Self { leave, ..self.clone() };
        let from = left.unwrap_or_else(|| self.start.map(|state| state.position));
        let targets = self.targets(&from)?;
        let budget = Budget::of(postures);
        let incumbent = Incumbent::default();
        Search { problem, left, budget: &budget, incumbent, clear: Vec::new(), known: Vec::new() }
            .run(&targets)
    }

    /// The postures that serve as an end, those first that are nearest to posture `from`; empty when there are none.
    pub fn targets_from(&self, from: &Posture) -> Vec<Target> {
        match &self.goal {
            Goal::Posture(at) => vec![Self::posture_target(*at)],
            Goal::Hand(goals) => self.target_search(goals, from).nearest(),
        }
    }

    /// The clearance in a segment of the movement.
    pub(crate) fn clearance(&self, segment: SegmentKind) -> Clearance<'_> {
        let Self { mechanism, collision_model, scene, .. } = *self;
        Clearance { mechanism, collision_model, scene, segment }
    }

    /// How far the hand leaves straight, and the posture after that; none when it is not to leave first. Where the arm cannot reach as far as
    /// it is asked to, less far; where it cannot go straight at all, as at the limit of a joint, the hand keeps clear of everything from the start.
    fn left(&self) -> Result<Option<(Leave, Posture)>, Refusal> {
        let posture = self.start.map(|state| state.position);
        let clearance = self.clearance(SegmentKind::Leave);
        if let Some(near) = clearance.nearest(&posture, 0.0) {
            let (link, other) = clearance.names(&near);
            return Err(Refusal::Start { link, other, short: -near.distance });
        }
        let Some((direction, distance)) = self.leave else { return Ok(None) };
        let palm = self.mechanism.arm.palm(&posture);
        let solver = NumericalIk { clearance, from: &posture, min_clearance: 0.0 };
        let goal = |leave: &Leave| self.mechanism.goal_of(&(Translation3::from(leave.0 * leave.1) * palm));
        let leaves = LEAVING.map(|fraction| (direction, fraction * distance));
        Ok(leaves.iter().find_map(|leave| Some((*leave, solver.solve(&goal(leave), 0.0, 0.0, &posture)?))))
    }

    /// The postures that serve as an end, best first.
    fn targets(&self, from: &Posture) -> Result<Vec<Target>, Refusal> {
        match &self.goal {
            Goal::Posture(at) => Ok(vec![Self::posture_target(*at)]),
            Goal::Hand(goals) => self.target_search(goals, from).best(),
        }
    }

    /// The posture that is asked for itself.
    fn posture_target(at: Posture) -> Target {
        Target { goal: 0, roll: 0.0, before: at, at, cost: 0.0 }
    }

    fn target_search<'b>(&'b self, goals: &'b [HandGoal], from: &'b Posture) -> TargetSearch<'b> {
        TargetSearch {
            clearance: self.clearance(SegmentKind::Approach),
            goals,
            from,
            next_displacements: &self.next_displacements,
            min_clearance: self.min_clearance,
            limits: self.mechanism.limits(),
        }
    }
}
