use super::schemas;
use super::values::time;
use coact_run_recording::{JsonSchema, Recorded};
use coact_run_records::{Event, LogFollower, SupervisorEvent};
use serde_json::{Value, json};
use std::path::Path;

/// What happened in the run, in words, as `foxglove.Log`: the lines of its logs, and what was said.
pub(crate) struct RunLogs {
    supervisor: LogFollower<SupervisorEvent>,
    events: LogFollower<Event>,
    /// Sentences of the person that were heard already.
    heard: u64,
    pub schema: JsonSchema,
}

/// Foxglove's level of what is usual.
const INFO: u32 = 2;

impl RunLogs {
    pub const TOPIC: &str = "/log";

    /// Of a report folder, from the beginning of its logs.
    pub fn new(report: &Path) -> Self {
        Self {
            supervisor: LogFollower::new(report),
            events: LogFollower::new(report),
            heard: 0,
            schema: schemas::log(),
        }
    }

    /// The lines that came since the last look: who wrote them, and the line.
    pub fn news(&mut self) -> Vec<(&'static str, String)> {
        // What cannot be read of a log is not recorded of it; the log itself is there.
        let supervisor = self.supervisor.news().unwrap_or_default();
        let events = self.events.news().unwrap_or_default();
        let supervisor = supervisor.iter().filter_map(|line| serde_json::to_string(line).ok());
        let events = events.iter().filter_map(|line| serde_json::to_string(line).ok());
        supervisor.map(|line| ("supervisor", line)).chain(events.map(|line| ("monitor", line))).collect()
    }

    /// What a message says in words, and who says it.
    pub fn sentence(&mut self, message: &Recorded) -> Option<(&'static str, String)> {
        match message {
            Recorded::Speech(speech) => Some(("robot", speech.sentence().to_owned())),
            Recorded::Sample(sample) if sample.heard.sentences > self.heard => {
                self.heard = sample.heard.sentences;
                Some(("person", sample.heard.sentence().to_owned()))
            }
            _ => None,
        }
    }

    /// One line at `ns` since 1970.
    pub fn line(ns: u64, name: &str, message: &str) -> Value {
        json!({
            "timestamp": time(ns),
            "level": INFO,
            "message": message,
            "name": name,
            "file": "",
            "line": 0,
        })
    }
}
