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

    /// Nobody died, as [`Finished::only_died`] tells.
    ///
    /// # Panics
    /// Somebody did.
    pub fn nobody_died(&self) {
        self.only_died(&[]);
    }

    /// These processes died, each once and in this order, and nobody else. A machine that others share stands still at times, and a stage is
    /// then taken for hung: one may be.
    ///
    /// # Panics
    /// One of them did not, or somebody else did.
    pub fn only_died(&self, expected: &[&str]) {
        let died = self.supervisor.iter().filter(|event| event.event == SupervisorEventKind::Died);
        let (own, others): (Vec<_>, Vec<_>) =
            died.partition(|event| expected.contains(&event.process.as_str()));
        let is_hung = |event: &&SupervisorEvent| {
            event.reason.as_deref().is_some_and(|reason| reason.starts_with("hung"))
        };
        let own: Vec<_> = own.iter().map(|event| event.process.as_str()).collect();
        let as_expected = own == expected && others.len() <= 1 && others.iter().all(is_hung);
        assert!(as_expected, "{own:?} {others:?}\n{}", self.stderr);
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
