//! Movements for control's skills: what is asked of the planner, where the hand goes, what it keeps clear of.

mod hand_goals;
#[cfg(test)]
mod modelled;
mod planner_delay;
mod planner_link;
mod planner_watch;
mod planner_within;
mod planning_query;
mod planning_result;
mod planning_scene;
mod planning_thread;
mod skill_planner;
mod slots;
mod surroundings;

pub(crate) use hand_goals::HandGoals;
pub use planner_delay::{PlannerDelay, UnknownDelay};
pub(crate) use planner_link::PlannerLink;
use planner_watch::PlannerWatch;
use planner_within::PlannerWithin;
pub(crate) use planning_query::PlanningQuery;
pub(crate) use planning_result::PlanningResult;
use planning_scene::PlanningScene;
pub use planning_thread::PlanningThread;
pub(crate) use skill_planner::{INSERTION_DEPTH, SkillPlanner};
pub(crate) use surroundings::Surroundings;
