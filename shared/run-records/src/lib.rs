//! What a run leaves in its report directory: one type for each file, used by whoever writes and whoever reads it.
//!
//! | file | type | one line is |
//! |---|---|---|
//! | `summary.json` | [`Summary`] | (the file is one object) |
//! | `events.jsonl`, the event log | [`Event`] | what happened in the task, or a fault |
//! | `supervisor.jsonl`, the supervisor log | [`SupervisorEvent`] | what happened to a process |
//! | `snapshots.jsonl`, the snapshot log | [`Snapshot`] | what the scene looked like at one instant |
//!
//! Between two runs at a console a [`NextRound`] lies there.
//!
//! `at_ms`, `onset_ms` and the like are numbers of cycles from the start of the run: a cycle lasts 1 ms. `at_ns` is an
//! instant of `CLOCK_MONOTONIC`.
//!
//! JSON Schemas of all four are in `docs/schemas`; a test of this crate holds them and the types together.
//!
//! ```
//! use coact_run_records::{Event, RunLog};
//!
//! let report = tempfile::tempdir()?;
//! let mut log = RunLog::<Event>::open(report.path())?;
//! log.append(vec![Event::Utterance { at_ms: 650, text: "I will hold it.".into() }])?;
//!
//! // Another process, or a program of your own, reads it back.
//! for event in RunLog::<Event>::read(report.path())? {
//!     if let Event::Utterance { at_ms, text } = event {
//!         assert_eq!((at_ms, text.as_str()), (650, "I will hold it."));
//!     }
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod action_event;
mod anticipation_report;
mod environment;
mod event;
mod fault_event;
mod fault_report;
mod judgement;
mod log_follower;
mod motion_report;
mod next_round;
mod operator_stop_report;
mod outage_report;
mod percentiles;
mod process_report;
mod reaction_report;
mod record;
mod record_error;
mod run_log;
#[cfg(test)]
mod schemas;
mod separation_report;
mod snapshot;
mod summary;
mod supervisor_event;
mod task_report;
mod timeline_span;
mod tracking_report;
mod wait_event;

pub use action_event::ActionEvent;
pub use anticipation_report::{AnticipationReport, LeadPercentiles};
pub use environment::{Environment, MachineReport};
pub use event::Event;
pub use fault_event::FaultEvent;
pub use fault_report::FaultReport;
pub use judgement::{Judgement, Verdict};
pub use log_follower::LogFollower;
pub use motion_report::{JointMoment, MotionReport};
pub use next_round::NextRound;
pub use operator_stop_report::OperatorStopReport;
pub use outage_report::OutageReport;
pub use percentiles::Percentiles;
pub use process_report::ProcessReport;
pub use reaction_report::ReactionReport;
pub use record::Record;
pub use record_error::RecordError;
pub use run_log::RunLog;
pub use separation_report::SeparationReport;
pub use snapshot::{JOINTS, KEYPOINTS, SeenPart, Snapshot};
pub use summary::Summary;
pub use supervisor_event::{SupervisorEvent, SupervisorEventKind};
pub use task_report::{Decided, Said, TaskReport};
pub use timeline_span::{Occupation, TimelineSpan};
pub use tracking_report::TrackingReport;
pub use wait_event::{WaitEvent, Waiting};
