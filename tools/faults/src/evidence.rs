use coact_run_records::{Event, RecordError, RunLog, Summary, SupervisorEvent};
use std::path::Path;
use std::process::ExitStatus;

/// How a set ended.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ending {
    /// Of the supervisor; none when it did not end by itself.
    pub(crate) status: Option<ExitStatus>,
    /// What there still is of the run.
    pub(crate) left_behind: Vec<String>,
}

/// What a run left to judge it by.
#[derive(Debug, Clone, Default)]
pub(crate) struct Evidence {
    pub(crate) ending: Ending,
    pub(crate) summary: Option<Summary>,
    pub(crate) events: Vec<Event>,
    pub(crate) supervisor: Vec<SupervisorEvent>,
    /// Release of tick 0, ns of `CLOCK_MONOTONIC`; none when the run did not begin.
    pub(crate) start_ns: Option<u64>,
    /// Speed of the fastest joint in the last sample, rad/s.
    pub(crate) last_speed: f64,
}

impl Evidence {
    /// Reads what stands in a report directory; a file that is not there is no error, one that is damaged is.
    pub(crate) fn read(report: &Path) -> Result<Self, RecordError> {
        let has = |file: &str| report.join(file).exists();
        let summary = if has(Summary::FILE) { Some(Summary::read(report)?) } else { None };
        let events = if has("events.jsonl") { RunLog::read(report)? } else { Vec::new() };
        let supervisor = if has("supervisor.jsonl") { RunLog::read(report)? } else { Vec::new() };
        Ok(Self { summary, events, supervisor, ..Self::default() })
    }

    /// An instant of the machine's clock in ms of the run.
    pub(crate) fn run_ms(&self, at_ns: u64) -> u64 {
        at_ns.saturating_sub(self.start_ns.unwrap_or(u64::MAX)) / 1_000_000
    }
}
