//! Learning of connections between the layers (chapter, section 7), by rules that correlate the activation of fields.
//!
//! - [`SerialOrder`]: from demonstrations, the two sublayers of CSGL learn which step needs which.
//! - [`Mapping`]: from actions that succeeded, AOL and ASL learn which act shows which chain.
//!
//! Both run fields with the constants of the task's own network file, and know no more than what they are handed.
//! [`Demonstration`] and [`TaskText`] are the files around serial order, [`MappingFile`] writes that of the mapping.
//!
//! ```
//! use coact_joint_task::NetworkPlan;
//! use coact_learning::{Demonstration, SerialOrder, Step};
//!
//! # let rt_config = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
//! let (task, plan) = NetworkPlan::load(&rt_config.join("tasks/toy-vehicle.toml"))?;
//! let mut learner = SerialOrder::new(&plan)?;
//! // Somebody achieves every subgoal in the order of the task file, one each half second.
//! let steps = (0..task.subgoals.len()).map(|subgoal| Step { at_ms: 500 * subgoal as u64, subgoal });
//! learner.watch(&Demonstration { source: "an example".into(), steps: steps.collect() });
//! // As far as this single demonstration tells, each subgoal needs the one before it.
//! assert_eq!(learner.order().plan()[1], [0]);
//! assert_eq!(learner.order().plan()[2], [1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod connection;
mod demonstration;
mod layer;
mod learn_error;
mod learned_order;
mod mapping;
mod mapping_file;
mod plastic_connection;
mod serial_order;
mod sublayers;
mod success_detector;
mod task_text;

pub use connection::Connection;
pub use demonstration::{Demonstration, Step};
pub use learn_error::LearnError;
pub use learned_order::LearnedOrder;
pub use mapping::Mapping;
pub use mapping_file::{MappingFile, Provenance};
pub use serial_order::SerialOrder;
pub use task_text::TaskText;
