//! Starts, watches, restarts and stops the processes of a run.
//!
//! [`Launch`] is the whole: it makes the run directory, creates every topic and keeps it open, starts the process table in
//! order, and supervises the set until its end. [`ProcessSet`] is the supervision alone; it knows no topics.
//!
//! When the supervisor itself has died, and the set may outlive it, [`Launch::adopt`] is its successor.
//!
//! A process that dies is noticed by its pidfd at once. Its checkpoint is published, and it is started again, as often as
//! the process table's restart policy allows. Everything that happens to a process is a line of the
//! [supervisor log](SupervisorLog), from which the monitor makes the report's fault lines.

mod checkpoints;
mod child;
mod control_socket;
mod death;
mod empty_files;
mod ending;
mod fault;
mod gave_up;
mod injection;
mod injection_refusal;
mod kill_reason;
mod launch;
mod launch_error;
mod note;
mod note_kind;
mod operator;
mod operator_stop;
mod process_set;
mod process_spec;
mod renderer;
mod restart_history;
mod run_loop;
mod run_progress;
mod run_topics;
mod running;
mod service_manager;
mod set_request;
mod spare;
mod start_fault;
mod stderr_tail;
mod supervised;
mod supervisor_log;
mod terminal;
mod topic_reader;
mod watch;
mod watch_clock;
mod watchdog;

pub use checkpoints::Checkpoints;
pub use child::RunningChild;
pub use control_socket::{Wanted, read_request};
pub use ending::Ending;
pub use fault::{Fault, UnknownFault};
pub use gave_up::GaveUp;
pub use injection::{Injection, InjectionError};
pub use injection_refusal::InjectionRefusal;
pub use launch::Launch;
pub use launch_error::LaunchError;
pub use note::Note;
pub use note_kind::NoteKind;
pub use operator_stop::StopRequest;
pub use process_set::{LineSink, ProcessSet};
pub use process_spec::ProcessSpec;
pub use restart_history::RestartHistory;
pub use run_progress::RunProgress;
pub use set_request::{RequestError, request_fault, request_stop};
pub use stderr_tail::StderrTail;
pub use supervisor_log::SupervisorLog;
pub use terminal::{Notes, Terminal};
