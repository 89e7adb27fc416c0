use crate::Event;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// `events.jsonl`: every event, on disk as soon as it was seen, and read back after a restart.
#[derive(Debug)]
pub struct Journal {
    file: File,
    events: Vec<Event>,
}

/// Why the journal could not be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The file could not be read or written.
    #[error("{path}: {cause}")]
    File {
        /// Of the journal.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// A line is no event.
    #[error("{path}:{line}: not an event of this program: {cause}; move the report away or name another one")]
    Line {
        /// Of the journal.
        path: PathBuf,
        /// Where, counted from 1.
        line: usize,
        /// What is wrong with it.
        cause: serde_json::Error,
    },
}

impl Journal {
    /// Name of the file in the report directory.
    pub const FILE: &'static str = "events.jsonl";

    /// Opens the journal of a report. A line that a killed predecessor could not finish is cut off.
    ///
    /// # Errors
    /// The file cannot be read or written, or holds something else.
    pub fn open(report: &Path) -> Result<Self, JournalError> {
        let path = report.join(Self::FILE);
        let error = |cause| JournalError::File { path: path.clone(), cause };
        let file = OpenOptions::new().create(true).append(true).open(&path).map_err(error)?;
        let text = std::fs::read_to_string(&path).map_err(error)?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        if whole < text.len() {
            file.set_len(whole as u64).map_err(error)?;
        }
        let mut events = Vec::new();
        for (number, line) in text[..whole].lines().enumerate() {
            let event = serde_json::from_str(line);
            events.push(event.map_err(|cause| JournalError::Line {
                path: path.clone(),
                line: number + 1,
                cause,
            })?);
        }
        Ok(Self { file, events })
    }

    /// Every event of the run so far.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Appends events.
    ///
    /// # Errors
    /// The file cannot be written; the events are kept in memory all the same.
    pub fn append(&mut self, events: Vec<Event>) -> std::io::Result<()> {
        let mut text = String::new();
        for event in &events {
            text.push_str(&serde_json::to_string(event)?);
            text.push('\n');
        }
        self.events.extend(events);
        self.file.write_all(text.as_bytes())
    }
}
