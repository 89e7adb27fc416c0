//! Learning of connections between the layers (chapter, section 7), by rules that correlate the activity of fields.
//!
//! - [`SerialOrder`]: from demonstrations, the two sublayers of CSGL learn which step needs which.
//! - Mapping: follows.
//!
//! Both hold fields with the constants of the task's own network file; neither knows a task, a file format or a clock
//! beyond what it is handed. [`Demonstration`] and [`TaskText`] are the files around serial order, [`MappingFile`]
//! that of the mapping.

mod demonstration;
mod learn_error;
mod order;
mod rule;
mod serial_order;
mod sublayers;
mod task_text;

pub use demonstration::{Demonstration, Step};
pub use learn_error::LearnError;
pub use order::Order;
pub use serial_order::SerialOrder;
pub use task_text::TaskText;
