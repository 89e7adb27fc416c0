use coact_motion::{Aim, Body, Clearance, Margin, Mechanism, Problem, Scene, StageKind};
use coact_robot::MotionState;
use nalgebra::Vector3;

/// One movement to be planned, with all that it needs.
#[derive(Debug, Clone)]
pub struct Case {
    /// Arm, hand and what it holds.
    pub body: Body,
    /// The surroundings.
    pub scene: Scene,
    /// State of the arm's joints at the start.
    pub start: [MotionState; 7],
    /// Straight back first: direction and distance, m.
    pub leave: Option<(Vector3<f64>, f64)>,
    /// Where to.
    pub aim: Aim,
    /// Last part of the approach on which the hand keeps to its line, m.
    pub guide: f64,
}

impl Case {
    /// The same as a problem for the planner.
    pub fn problem<'a>(&'a self, mechanism: &'a Mechanism) -> Problem<'a> {
        Problem {
            mechanism,
            body: &self.body,
            scene: &self.scene,
            start: self.start,
            leave: self.leave,
            aim: self.aim.clone(),
            then: Vec::new(),
            guide: self.guide,
            margin: Margin::default(),
        }
    }

    /// Whether it starts clear of everything.
    pub(crate) fn starts_clear(&self, mechanism: &Mechanism) -> bool {
        let clearance =
            Clearance { mechanism, body: &self.body, scene: &self.scene, stage: StageKind::Reach };
        clearance.is_clear(&self.start.map(|state| state.position), ROOM)
    }
}

/// Room around the arm at the start, m.
const ROOM: f64 = 0.02;
