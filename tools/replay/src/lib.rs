//! A recorded run is computed again: the recorded sensor samples go through perception and fields, and what they make of them is
//! compared with what was recorded, to the bit.
//!
//! In real time a stage may use an older input, skip a cycle, or be replaced. All of that stands in the recording: each output's
//! header says its cycle, each pulse says on which input it was computed, and a sequence that goes on says that a replacement was
//! resumed from its predecessor's last message. So each cycle is computed on what it was computed on then. Where an input is
//! not in the recording, the stage goes on from the next message of its own that is: it is its state.
//!
//! Commands are not compared: control's planner answers when it is ready, and no message says in which cycle that was.

mod difference;
mod fields_replay;
mod in_order;
mod kept;
mod perception_replay;
mod replay;
mod replay_error;
mod replay_report;
mod stage_replay;
mod stages;

pub use difference::Difference;
pub use replay::replay;
pub use replay_error::ReplayError;
pub use replay_report::{ReplayReport, StageReport};
