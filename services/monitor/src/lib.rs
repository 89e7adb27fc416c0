//! Latency histograms, deadline accounts, and the proof that decisions came in time.
//!
//! Pure parts see messages and give [`Event`]s: [`Anticipation`] (did the right decision stand before the grasp
//! was complete?), [`TaskWatch`] (subgoals, decisions, utterances), [`Faults`] (detection, recovery, survivors'
//! misses). [`Latencies`] keeps histograms and accounts, a [`Journal`] keeps events, [`Album`] the moments in which
//! parts changed hands; all are on disk within a second, and a restarted monitor goes on from there. [`Summary`] draws
//! the conclusions; [`plots`] shows them.
//!
//! The report directory then holds `summary.json`, `events.jsonl`, `album.jsonl`, `latency/*.hlog` with `latency/accounts.json`,
//! and `plots/*.svg`. What a run must reach is in `rt-config/verdict.toml` ([`Rules`]).

mod account;
mod action_event;
mod album;
mod anticipation;
mod environment;
mod event;
mod expectation;
mod fault_event;
mod faults;
pub mod figures;
mod holdings;
mod intentions;
mod interval_log;
mod journal;
mod latencies;
mod links;
mod moment;
mod monitor;
pub mod plots;
mod reaction;
mod recorder;
mod rules;
mod sightings;
mod summary;
mod supervisor_log;
mod task_report;
mod task_watch;
mod tracking;
mod verdict;

pub use account::{Account, Lapse};
pub use action_event::ActionEvent;
pub use album::Album;
pub use anticipation::Anticipation;
pub use environment::{Environment, MachineReport};
pub use event::Event;
pub use fault_event::FaultEvent;
pub use faults::Faults;
pub use figures::{Figures, Link};
pub use intentions::Intentions;
pub use interval_log::{IntervalLog, IntervalLogError, LogContents};
pub use journal::{Journal, JournalError};
pub use latencies::{Latencies, LatencyError};
pub use links::links;
pub use moment::{Moment, SeenPart};
pub use monitor::{Monitor, MonitorError, Watched, write_summary};
pub use reaction::{Reaction, ReactionReport};
pub use recorder::{INTERVAL_NS, Recorder, histogram};
pub use rules::{Rules, RulesError};
pub use summary::{
    AnticipationReport, FaultReport, Findings, LeadPercentiles, Percentiles, ProcessReport, Summary,
};
pub use supervisor_log::{SupervisorEvent, SupervisorEventKind, SupervisorLog};
pub use task_report::{Decided, Said, TaskReport};
pub use task_watch::TaskWatch;
pub use tracking::{Tracking, TrackingReport};
