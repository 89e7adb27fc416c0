use coact_run_records::{Event, Record, RunLog, Summary, SupervisorEvent, SupervisorEventKind};
use std::path::Path;

/// What a run left to read.
#[derive(Debug)]
pub struct Finished {
    /// Exit status; none when a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
    /// The event log; empty when there is none.
    pub events: Vec<Event>,
    /// The supervisor log; empty when there is none.
    pub supervisor: Vec<SupervisorEvent>,
    summary: Option<Summary>,
}

impl Finished {
    /// Reads a report directory.
    pub(crate) fn read(report: &Path, code: Option<i32>, stdout: String, stderr: String) -> Self {
        let summary = report.join(Summary::FILE).exists().then(|| Summary::read(report).unwrap());
        Self { code, stdout, stderr, events: log(report), supervisor: log(report), summary }
    }

    /// `summary.json`.
    ///
    /// # Panics
    /// There is none.
    pub fn summary(&self) -> &Summary {
        self.summary.as_ref().unwrap_or_else(|| panic!("the run left no summary: {}", self.stderr))
    }

    /// How often this happened to this process.
    pub fn count(&self, kind: SupervisorEventKind, process: &str) -> usize {
        self.supervisor.iter().filter(|event| event.event == kind && event.process == process).count()
    }

    /// Nobody died. A machine that others share stands still at times, and a stage is then taken for hung: one may be.
    ///
    /// # Panics
    /// Somebody did.
    pub fn nobody_died(&self) {
        let hung = |event: &&SupervisorEvent| {
            event.reason.as_deref().is_some_and(|reason| reason.starts_with("hung"))
        };
        let died = self.supervisor.iter().filter(|event| event.event == SupervisorEventKind::Died);
        let (hung, otherwise): (Vec<_>, Vec<_>) = died.partition(hung);
        assert!(otherwise.is_empty() && hung.len() <= 1, "{otherwise:?} {hung:?}");
    }

    /// Cycles of a process.
    pub fn cycles(&self, process: &str) -> u64 {
        self.summary().processes.get(process).map_or(0, |report| report.cycles)
    }
}

fn log<R: Record>(report: &Path) -> Vec<R> {
    match report.join(R::FILE).exists() {
        true => RunLog::read(report).unwrap(),
        false => Vec::new(),
    }
}
