//! What control keeps from cycle to cycle: nested structs of fixed layout, which stand as words in each command.

mod arm_state;
mod arm_trajectory;
mod control_state;
mod decision_state;
mod finger_state;
mod finished_action;
mod hand_state;
mod movement_query;
mod phase_progress;
mod planning_state;
mod query_id;
mod skill;
mod skill_phase;
mod skill_state;
mod stored_pose;

pub(crate) use arm_state::ArmState;
pub(crate) use arm_trajectory::ArmTrajectory;
pub(crate) use control_state::{ControlState, split};
pub(crate) use decision_state::DecisionState;
pub(crate) use finger_state::FingerState;
pub(crate) use finished_action::FinishedAction;
pub(crate) use hand_state::HandState;
pub(crate) use movement_query::MovementQuery;
pub(crate) use phase_progress::PhaseProgress;
pub(crate) use planning_state::PlanningState;
pub(crate) use query_id::QueryId;
pub(crate) use skill::Skill;
pub(crate) use skill_phase::SkillPhase;
pub(crate) use skill_state::SkillState;
pub(crate) use stored_pose::StoredPose;

use coact_messages::{ARM_JOINTS, JOINTS};

/// Joints of the hand, the last of them reserved.
pub(crate) const FINGER_JOINTS: usize = JOINTS - ARM_JOINTS;
