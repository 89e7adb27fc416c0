//! Learning of connections between the layers (chapter, section 7), by rules that correlate the activity of fields.
//!
//! - [`SerialOrder`]: from demonstrations, the two sublayers of CSGL learn which step needs which.
//! - [`Mapping`]: from actions that succeeded, AOL and ASL learn which act shows which chain.
//!
//! Both hold fields with the constants of the task's own network file; neither knows a task, a file format or a clock
//! beyond what it is handed. [`Demonstration`] and [`TaskText`] are the files around serial order, [`MappingFile`]
//! writes that of the mapping.

mod demonstration;
mod layer;
mod learn_error;
mod mapping;
mod mapping_file;
mod order;
mod outcomes;
mod rule;
mod serial_order;
mod sublayers;
mod task_text;

pub use demonstration::{Demonstration, Step};
pub use learn_error::LearnError;
pub use mapping::{Connection, Mapping};
pub use mapping_file::{MappingFile, Provenance};
pub use order::Order;
pub use serial_order::SerialOrder;
pub use task_text::TaskText;
