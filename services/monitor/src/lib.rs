//! Latency histograms, deadline misses, and the proof that decisions came in time.
//!
//! Pure parts read messages and give [`Event`](coact_run_records::Event)s: [`Anticipation`] (did the right decision
//! stand before the grasp was complete?), [`TaskWatch`] (subgoals, decisions, utterances), [`Waits`] (who waited for whom), [`Faults`] (detection,
//! recovery, survivors' misses). [`Latencies`] writes histograms and counters, [`SnapshotLog`] what the scene looked like
//! when a part changed hands. All are on disk within a second, and a restarted monitor goes on from there. [`Findings`]
//! draw the conclusions; [`plots`] show them.
//!
//! The report directory then holds `summary.json`, `events.jsonl` and `snapshots.jsonl` (see [`coact_run_records`]),
//! `latency/*.hlog` with `latency/counters.json`, and `plots/*.svg`. What a run must reach is in
//! `rt-config/verdict.toml` ([`Rules`]).

mod active_agents;
mod anticipation;
mod blindness;
mod duration_recorder;
pub mod environment;
mod expectation;
mod faults;
mod findings;
mod intentions;
mod interval_log;
mod joint_motion;
mod latencies;
pub mod metrics;
mod monitor;
mod monitor_error;
mod outage;
mod part_locations;
mod pipeline_node;
pub mod plots;
mod process_counters;
mod pulse_inputs;
mod reaction;
mod recognised_parts;
mod rules;
mod snapshot_log;
mod task_watch;
mod timeline;
mod tracking;
mod verdict;
mod waits;
mod watched;

pub use active_agents::ActiveAgents;
pub use anticipation::Anticipation;
pub use duration_recorder::{DurationRecorder, INTERVAL_NS, histogram, percentiles};
pub use faults::Faults;
pub use findings::Findings;
pub use intentions::Intentions;
pub use interval_log::{IntervalLog, IntervalLogError, LogContents};
pub use joint_motion::JointMotion;
pub use latencies::{Latencies, LatencyError};
pub use metrics::Metrics;
pub use monitor::Monitor;
pub use monitor_error::MonitorError;
pub use outage::Outage;
pub use pipeline_node::PipelineNode;
pub use process_counters::{CycleFindings, ProcessCounters};
pub use pulse_inputs::PulseInputs;
pub use reaction::Reaction;
pub use rules::{Rules, RulesError};
pub use snapshot_log::SnapshotLog;
pub use task_watch::TaskWatch;
pub use timeline::Timeline;
pub use tracking::Tracking;
pub use waits::Waits;
pub use watched::Watched;
