use crate::run_log::{parse, whole_lines};
use crate::{Record, RecordError};
use std::fs::File;
use std::io::{ErrorKind, Read, Seek, SeekFrom};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

/// Follows a log that another process writes.
#[derive(Debug)]
pub struct LogFollower<R> {
    path: PathBuf,
    /// Bytes and lines that were read already.
    bytes: u64,
    lines: usize,
    records: PhantomData<fn() -> R>,
}

impl<R: Record> LogFollower<R> {
    /// Of a report directory, from the log's beginning.
    pub fn new(report: &Path) -> Self {
        Self { path: report.join(R::FILE), bytes: 0, lines: 0, records: PhantomData }
    }

    /// The records that came since the last call; none while there is no such file. A line that is still being written
    /// comes with a later call.
    ///
    /// # Errors
    /// The file cannot be read, or a line of it is damaged.
    pub fn news(&mut self) -> Result<Vec<R>, RecordError> {
        let text = match self.unread() {
            Err(cause) if cause.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
            read => read.map_err(|cause| RecordError::File { path: self.path.clone(), cause })?,
        };
        let whole = whole_lines(&text);
        let first = self.lines + 1;
        self.bytes += whole.len() as u64;
        self.lines += whole.lines().count();
        parse(&self.path, whole, first)
    }

    fn unread(&self) -> std::io::Result<String> {
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(self.bytes))?;
        let mut text = String::new();
        file.read_to_string(&mut text)?;
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Event, RunLog};
    use std::fs::OpenOptions;
    use std::io::Write;

    fn said(text: &str) -> Event {
        Event::Utterance { at_ms: 5, text: text.into() }
    }

    #[test]
    fn each_record_comes_once_and_a_damaged_line_is_named_by_its_number_in_the_file() {
        let report = tempfile::tempdir().unwrap();
        let mut follower = LogFollower::<Event>::new(report.path());
        assert_eq!(follower.news().unwrap(), []);
        let mut log = RunLog::create(report.path()).unwrap();
        log.append(vec![said("one"), said("two")]).unwrap();
        assert_eq!(follower.news().unwrap(), [said("one"), said("two")]);
        let mut file = OpenOptions::new().append(true).open(&follower.path).unwrap();
        file.write_all(b"{\"at_ms\":3").unwrap();
        assert_eq!(follower.news().unwrap(), []);
        file.write_all(b",\n").unwrap();
        let error = follower.news().unwrap_err().to_string();
        assert!(error.contains("events.jsonl:3: not a line of this log"), "{error}");
    }
}
