use coact_motion::{Clearance, CollisionModel, Goal, Mechanism, Problem, Scene, SegmentKind};
use coact_robot::MotionState;
use nalgebra::Vector3;

/// One movement to be planned, with all that it needs.
#[derive(Debug, Clone)]
pub struct Case {
    /// Arm, hand and what it holds.
    pub collision_model: CollisionModel,
    /// The surroundings.
    pub scene: Scene,
    /// State of the arm's joints at the start.
    pub start: [MotionState; 7],
    /// Straight back first: direction (unit, world) and distance, m.
    pub leave: Option<(Vector3<f64>, f64)>,
    /// Where the movement ends.
    pub goal: Goal,
    /// Length of the last part of the approach on which the hand keeps to a straight line, m.
    pub insertion_depth: f64,
}

impl Case {
    /// The same as a problem for the planner.
    pub fn problem<'a>(&'a self, mechanism: &'a Mechanism) -> Problem<'a> {
        let goal = self.goal.clone();
        let problem = Problem::new(mechanism, &self.collision_model, &self.scene, self.start, goal);
        Problem { leave: self.leave, insertion_depth: self.insertion_depth, ..problem }
    }

    /// Whether it starts clear of everything.
    pub(crate) fn starts_clear(&self, mechanism: &Mechanism) -> bool {
        let clearance = Clearance {
            mechanism,
            collision_model: &self.collision_model,
            scene: &self.scene,
            segment: SegmentKind::Reach,
        };
        clearance.is_clear(&self.start.map(|state| state.position), CLEAR_START)
    }
}

/// Clearance of the arm at the start, m: cases are about the path, not about a start in a corner. Chosen by hand.
const CLEAR_START: f64 = 0.02;
