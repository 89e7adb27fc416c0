//! Whether the hand gets where a task needs it: known before the first movement.

use crate::ControlError;
use crate::planning::{HandGoals, INSERTION_DEPTH, SkillPlanner};
use crate::robot::GripGoal;
use coact_joint_task::{Action, ActionType, Task};
use coact_robot::NextUse;

/// Refuses a task with a place that the hand needs and cannot reach.
///
/// # Errors
/// [`ControlError::Unreachable`], [`ControlError::Robot`].
pub(crate) fn check(planner: &SkillPlanner, goals: &HandGoals, task: &Task) -> Result<(), ControlError> {
    for action in &task.actions {
        let needed = needed(goals, action);
        let Some(GripGoal { goal, .. }) = needed.first().copied() else { continue };
        if !planner.reaches(needed.into_iter().map(|needed| needed.goal).collect())? {
            let [x, y, z]: [f64; 3] = goal.approach.into();
            return Err(ControlError::Unreachable {
                what: format!("the place for \"{}\"", action.name),
                place: goal.point.coords.into(),
                towards: format!("pointing along ({x:.2}, {y:.2}, {z:.2}) and {:.2} m before it", goal.back),
            });
        }
    }
    Ok(())
}

/// Goals of which the hand must reach one for an action. Where parts lie on the table is not known yet.
fn needed(goals: &HandGoals, action: &Action) -> Vec<GripGoal> {
    match (action.action_type, action.kind, action.subgoal) {
        (ActionType::Insert, Some(kind), Some(subgoal)) => {
            goals.grasping(kind, NextUse::Insert { depth: INSERTION_DEPTH }, &goals.socket(subgoal))
        }
        (ActionType::Request | ActionType::Receive | ActionType::Give, Some(kind), _) => {
            goals.grasping(kind, NextUse::Anything, &goals.handover_frame())
        }
        (ActionType::Steady, ..) => goals.steadying(),
        _ => Vec::new(),
    }
}
