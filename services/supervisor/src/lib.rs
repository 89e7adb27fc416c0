//! Starts, watches, restarts and stops the processes of a run.

mod child;
mod clock;
mod event;
mod event_log;
mod fault;
mod give_up;
mod injection;
mod intensity;
mod process_set;
mod process_spec;
mod refusal;
mod stderr_tail;
mod supervised;
mod survivors;

pub use child::RunningChild;
pub use event::{Event, EventKind};
pub use event_log::EventLog;
pub use fault::{Fault, UnknownFault};
pub use give_up::GaveUp;
pub use injection::{Injection, InjectionError};
pub use intensity::{Intensity, Remedy, RestartLedger};
pub use process_set::{LineSink, ProcessSet};
pub use process_spec::ProcessSpec;
pub use refusal::Refusal;
pub use stderr_tail::StderrTail;
pub use survivors::Survivors;
