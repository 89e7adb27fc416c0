//! A joint task from a file: parts, plan, what a person's hand can show, what the robot can do, and the rules that
//! make populations and synapses of the field network from it.
//!
//! ```
//! use coact_joint_task::{ActionType, NetworkPlan, Role};
//! use coact_messages::LayerKind;
//! use std::path::Path;
//!
//! # let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config"));
//! let (task, plan) = NetworkPlan::load(&folder.join("tasks/toy-vehicle.toml"))?;
//!
//! // Each act of the person, chain of acts and action of the robot has one population in its layer.
//! assert_eq!(plan.populations_of(LayerKind::ActionObservation).len(), task.acts.len());
//! assert_eq!(plan.populations_of(LayerKind::ActionSimulation).len(), task.chains.len());
//! assert_eq!(plan.populations_of(LayerKind::ActionExecution).len(), task.actions.len());
//!
//! // Who grasps a wheel from above means to insert it: the robot steadies the base meanwhile.
//! let inserts = task.chains.iter().position(|chain| chain.name == "insert").expect("a chain of the task");
//! let goal = task.goal_of(inserts, |_| true).expect("a subgoal that it serves");
//! let answer = task.complement(inserts, goal).expect("an action that complements it");
//! assert_eq!(task.actions[answer].action_type, ActionType::Steady);
//! assert_eq!(plan.populations_of(LayerKind::ActionExecution)[answer].role, Role::Steady);
//! # Ok::<(), coact_joint_task::TaskError>(())
//! ```

mod act;
mod action;
mod agent;
mod chain;
mod check;
mod choice;
mod fixture;
mod gesture;
mod kind;
mod learned_mapping;
mod load_task;
mod network_file;
mod network_plan;
mod part;
mod percept_channels;
mod person_grip;
mod population;
mod role;
mod room;
mod scene;
mod selection_fields;
mod selection_plan;
mod source_file;
mod subgoal;
mod synapse_rules;
mod task;
mod task_error;
mod task_file;
mod wiring;

pub use act::Act;
pub use action::{Action, ActionType};
pub use agent::Agent;
pub use chain::Chain;
pub use check::{Finding, FindingKind, check};
pub use choice::Choice;
pub use fixture::{Fixture, FixtureForm};
pub use gesture::Gesture;
pub use kind::{Kind, Shape};
pub use network_plan::{Channel, ChannelPlan, LayerPlan, NetworkPlan, Pool, Synapse};
pub use part::Part;
pub use person_grip::PersonGrip;
pub use population::Population;
pub use role::Role;
pub use scene::{Fit, Scene};
pub use selection_plan::SelectionPlan;
pub use subgoal::Subgoal;
pub use task::Task;
pub use task_error::TaskError;
