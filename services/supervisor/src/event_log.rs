use crate::Event;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// `supervisor.jsonl`: one JSON line for each event, on disk as soon as it happened.
#[derive(Debug)]
pub struct EventLog {
    path: PathBuf,
    file: File,
    /// A write failed and was reported: the run goes on, but not in silence.
    failed: bool,
}

impl EventLog {
    /// Name of the file in the report directory.
    pub const FILE: &'static str = "supervisor.jsonl";

    /// Creates the file in the report directory.
    ///
    /// # Errors
    /// The file cannot be created.
    pub fn create(report: &Path) -> std::io::Result<Self> {
        let path = report.join(Self::FILE);
        let file = File::create(&path)?;
        Ok(Self { path, file, failed: false })
    }

    /// Writes one event. A full disk must not stop the supervision: the first failure is warned of, once.
    pub fn write(&mut self, event: &Event) {
        let written = serde_json::to_string(event)
            .map_err(std::io::Error::from)
            .and_then(|line| self.file.write_all(format!("{line}\n").as_bytes()));
        if let (Err(error), false) = (written, self.failed) {
            self.failed = true;
            tracing::warn!("{}: {error}; events are missing from it", self.path.display());
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::EventKind;

    #[test]
    fn each_event_is_one_line_with_the_documented_keys() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = EventLog::create(folder.path()).unwrap();
        let started = Event {
            at_ns: 5,
            event: EventKind::Started,
            process: "fields".into(),
            generation: 0,
            pid: 7,
            fault: None,
            reason: None,
        };
        let given_up = Event { event: EventKind::GaveUp, reason: Some("why".into()), ..started.clone() };
        log.write(&started);
        log.write(&given_up);
        let text = std::fs::read_to_string(folder.path().join(EventLog::FILE)).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], r#"{"at_ns":5,"event":"started","process":"fields","generation":0,"pid":7}"#);
        assert_eq!(serde_json::from_str::<Event>(lines[1]).unwrap(), given_up);
        assert!(lines[1].contains(r#""event":"gave_up""#), "{text}");
    }
}
