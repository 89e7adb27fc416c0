//! Starts, watches, restarts and stops the processes of a run.
//!
//! [`Launch`] is the whole: it makes the run directory, creates and holds every topic, starts the process table in
//! order, and attends to the set until its end. [`ProcessSet`] is the supervision alone; it knows no topics.
//!
//! A process that dies is noticed by its pidfd at once, offered its predecessor's last message, and started again,
//! as often as the process table's restart policy allows. Everything that happens to a process is a line of
//! [`EventLog`], from which the monitor makes the report's fault lines.

mod child;
mod clock;
mod control_socket;
mod event;
mod event_log;
mod fault;
mod give_up;
mod injection;
mod kept_messages;
mod launch;
mod launch_error;
mod note;
mod observer;
mod process_set;
mod process_spec;
mod progress;
mod refusal;
mod restart_ledger;
mod scheduling;
mod session;
mod stderr_tail;
mod supervised;
mod survivors;
mod terminal;

pub use child::RunningChild;
pub use clock::now;
pub use control_socket::{AskError, ask_for_fault};
pub use event::{Event, EventKind};
pub use event_log::EventLog;
pub use fault::{Fault, UnknownFault};
pub use give_up::GaveUp;
pub use injection::{Injection, InjectionError};
pub use launch::{Ending, Launch};
pub use launch_error::LaunchError;
pub use note::{Note, Tone};
pub use process_set::{LineSink, ProcessSet};
pub use process_spec::ProcessSpec;
pub use progress::Progress;
pub use refusal::Refusal;
pub use restart_ledger::RestartLedger;
pub use stderr_tail::StderrTail;
pub use survivors::Survivors;
pub use terminal::{Notes, Terminal};
