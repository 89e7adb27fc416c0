use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// What the supervisor writes down about the processes: one line of `supervisor.jsonl`.
#[derive(Debug, Clone, PartialEq, Eq, serde::Deserialize)]
pub struct SupervisorEvent {
    /// When it was seen or done, ns of `CLOCK_MONOTONIC`.
    pub at_ns: u64,
    /// What happened.
    pub event: SupervisorEventKind,
    /// Name of the process.
    pub process: String,
    /// How often the process had been restarted before.
    pub generation: u32,
    /// Name of the injected fault, if one was.
    #[serde(default)]
    pub fault: Option<String>,
    /// Why: how it died, why it was given up.
    #[serde(default)]
    pub reason: Option<String>,
}

/// What may happen to a process; kinds that no report needs are [`Other`](Self::Other).
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SupervisorEventKind {
    /// Reported ready.
    Ready,
    /// Found dead.
    Died,
    /// Not started again.
    GaveUp,
    /// About to get a fault injected.
    Injected,
    /// Anything else.
    #[serde(other)]
    Other,
}

/// Follows `supervisor.jsonl` while it grows.
#[derive(Debug)]
pub struct SupervisorLog {
    path: PathBuf,
    read: u64,
}

impl SupervisorLog {
    /// Of a report directory, from the log's beginning.
    pub fn new(report: &Path) -> Self {
        Self { path: report.join("supervisor.jsonl"), read: 0 }
    }

    /// The events that came since the last call; none while there is no such file.
    ///
    /// # Errors
    /// The file cannot be read, or a line of it is none of the supervisor's.
    pub fn news(&mut self) -> std::io::Result<Vec<SupervisorEvent>> {
        let mut file = match File::open(&self.path) {
            Ok(file) => file,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(error),
        };
        file.seek(SeekFrom::Start(self.read))?;
        let mut text = String::new();
        file.read_to_string(&mut text)?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        self.read += whole as u64;
        text[..whole].lines().map(|line| serde_json::from_str(line).map_err(std::io::Error::from)).collect()
    }
}
