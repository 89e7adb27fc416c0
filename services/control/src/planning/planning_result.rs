use crate::state::ArmTrajectory;

/// What the planner answers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlanningResult {
    /// The trajectory, or none.
    pub trajectory: Option<ArmTrajectory>,
    /// The grip in which the hand grasps a part at its end, if it does: index into the [grip table](crate::robot::GripTable).
    pub grip: Option<usize>,
}

impl PlanningResult {
    /// No movement was found.
    pub const REFUSED: Self = Self { trajectory: None, grip: None };
}
