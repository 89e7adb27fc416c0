use crate::{Record, RecordError};
use coact_input_file::{LONGEST_LOG, read_text_within};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

/// A file of JSON lines: every record is on disk as soon as it was made, and is read back after a restart.
#[derive(Debug)]
pub struct RunLog<R> {
    path: PathBuf,
    file: File,
    records: Vec<R>,
}

impl<R: Record> RunLog<R> {
    /// Begins the log of a report directory; what an earlier run left in it is removed.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(report: &Path) -> Result<Self, RecordError> {
        let path = report.join(R::FILE);
        let file = private().write(true).truncate(true).open(&path);
        let file = file.map_err(|cause| RecordError::File { path: path.clone(), cause })?;
        Ok(Self { path, file, records: Vec::new() })
    }

    /// Opens the log of a report directory and goes on with what is in it. A line that a killed predecessor could not
    /// finish is cut off.
    ///
    /// # Errors
    /// The file cannot be read or written, or holds something else.
    pub fn open(report: &Path) -> Result<Self, RecordError> {
        let path = report.join(R::FILE);
        let error = |cause| RecordError::File { path: path.clone(), cause };
        let file = private().append(true).open(&path).map_err(error)?;
        let text = read_text_within(&path, LONGEST_LOG).map_err(error)?;
        let whole = whole_lines(&text);
        if whole.len() < text.len() {
            file.set_len(whole.len() as u64).map_err(error)?;
        }
        let records = parse(&path, whole, 1)?;
        Ok(Self { path, file, records })
    }

    /// Reads the log of a report directory that nobody writes any more; a last line without its end is left out.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub fn read(report: &Path) -> Result<Vec<R>, RecordError> {
        Self::read_file(&report.join(R::FILE))
    }

    /// The same of a log that may have been moved or renamed. The record of line n has index n - 1.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_file(path: &Path) -> Result<Vec<R>, RecordError> {
        let text = read_text_within(path, LONGEST_LOG)
            .map_err(|cause| RecordError::File { path: path.to_owned(), cause })?;
        parse(path, whole_lines(&text), 1)
    }

    /// Every record so far.
    pub fn records(&self) -> &[R] {
        &self.records
    }

    /// Appends records.
    ///
    /// # Errors
    /// The file cannot be written; the records are in [`records`](Self::records) all the same.
    pub fn append(&mut self, records: Vec<R>) -> Result<(), RecordError> {
        let lines = records.iter().map(|record| serde_json::to_string(record).map(|line| line + "\n"));
        let text: Result<String, _> = lines.collect();
        self.records.extend(records);
        text.map_err(std::io::Error::from)
            .and_then(|text| self.file.write_all(text.as_bytes()))
            .map_err(|cause| RecordError::File { path: self.path.clone(), cause })
    }
}

/// A file is made, if there is none, that nobody else can open, whatever the umask.
fn private() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.create(true).mode(0o600);
    options
}

/// Without a last line that its writer has not finished.
pub(crate) fn whole_lines(text: &str) -> &str {
    &text[..text.rfind('\n').map_or(0, |end| end + 1)]
}

/// The records of whole lines, of which the first has the number `first` in the file.
pub(crate) fn parse<R: Record>(path: &Path, lines: &str, first: usize) -> Result<Vec<R>, RecordError> {
    let record = |(line, text)| {
        serde_json::from_str(text).map_err(|cause| RecordError::Line { path: path.to_owned(), line, cause })
    };
    (first..).zip(lines.lines()).map(record).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::Event;

    fn said(text: &str) -> Event {
        Event::Utterance { at_ms: 5, text: text.into() }
    }

    #[test]
    fn a_log_that_is_opened_again_goes_on_after_its_last_whole_line() {
        let report = tempfile::tempdir().unwrap();
        let mut killed = RunLog::open(report.path()).unwrap();
        killed.append(vec![said("one"), said("two")]).unwrap();
        killed.file.write_all(b"{\"event\":\"utter").unwrap();
        assert_eq!(RunLog::<Event>::read(report.path()).unwrap().len(), 2);
        let mut log = RunLog::open(report.path()).unwrap();
        log.append(vec![said("three")]).unwrap();
        let all = [said("one"), said("two"), said("three")];
        assert_eq!(log.records(), all);
        assert_eq!(RunLog::<Event>::read(report.path()).unwrap(), all);
    }

    #[test]
    fn a_log_that_is_created_holds_nothing_of_an_earlier_run() {
        let report = tempfile::tempdir().unwrap();
        RunLog::open(report.path()).unwrap().append(vec![said("one")]).unwrap();
        assert_eq!(RunLog::<Event>::create(report.path()).unwrap().records(), []);
        assert_eq!(RunLog::<Event>::read(report.path()).unwrap(), []);
    }

    #[test]
    fn a_damaged_line_and_one_of_an_unknown_event_are_named_with_their_place() {
        let report = tempfile::tempdir().unwrap();
        let good = serde_json::to_string(&said("one")).unwrap();
        for bad in ["{\"event\":\"dance\"}", "{\"event\":", "", "{\"event\":\"utterance\",\"at_ms\":1}"] {
            std::fs::write(report.path().join(Event::FILE), format!("{good}\n{bad}\n")).unwrap();
            for error in [
                RunLog::<Event>::open(report.path()).map(|_| ()).unwrap_err(),
                RunLog::<Event>::read(report.path()).map(|_| ()).unwrap_err(),
            ] {
                let error = error.to_string();
                assert!(error.contains("events.jsonl:2: not a line of this log"), "{bad}: {error}");
            }
        }
    }

    #[test]
    fn a_missing_log_is_named() {
        let report = tempfile::tempdir().unwrap();
        let error = RunLog::<Event>::read(report.path()).unwrap_err().to_string();
        assert!(error.contains("events.jsonl: No such file"), "{error}");
    }
}
