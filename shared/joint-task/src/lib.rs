//! A joint task from a file: parts, plan, what a person's hand can show, what the robot can do, and the rules that
//! make populations and synapses of the field network from it.

mod check;
mod error;
mod file;
mod fixture;
mod learned;
mod load;
mod model;
mod network_file;
mod network_plan;
mod population;
mod task;
mod wiring;

pub use check::{Finding, FindingKind, check};
pub use error::TaskError;
pub use fixture::{Fixture, FixtureForm};
pub use model::{
    Act, Action, ActionType, Agent, Chain, Fit, Gesture, Grip, Kind, Part, Scene, Shape, Subgoal,
};
pub use network_plan::{Channel, ChannelPlan, LayerPlan, NetworkPlan, Pool, Synapse};
pub use population::Population;
pub use task::Task;
