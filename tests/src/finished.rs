use coact_supervisor::{Event, EventKind};
use serde_json::Value;

/// What a run left to read.
#[derive(Debug)]
pub struct Finished {
    /// Exit status; none when a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
    /// `summary.json`; null when there is none.
    pub summary: Value,
    /// `events.jsonl`.
    pub journal: String,
    /// `supervisor.jsonl`.
    pub supervisor: String,
}

impl Finished {
    /// How often this happened to this process.
    pub fn count(&self, kind: EventKind, process: &str) -> usize {
        self.events().iter().filter(|event| event.event == kind && event.process == process).count()
    }

    /// All that the supervisor wrote down.
    pub fn events(&self) -> Vec<Event> {
        self.supervisor.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    /// How many lines of the monitor's journal are of this kind.
    pub fn journalled(&self, event: &str) -> usize {
        let lines = self.journal.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        lines.filter(|line| line["event"] == event).count()
    }

    /// Cycles of a process.
    pub fn cycles(&self, process: &str) -> u64 {
        self.summary["processes"][process]["cycles"].as_u64().unwrap_or(0)
    }

    /// Subgoals achieved in the assembly that came furthest.
    pub fn achieved(&self) -> u64 {
        self.summary["task"]["achieved"].as_u64().unwrap_or(0)
    }
}
