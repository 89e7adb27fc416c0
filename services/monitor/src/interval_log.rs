use crate::duration_recorder::{INTERVAL_NS, histogram};
use base64::Engine;
use coact_input_file::{LONGEST_LOG, read_within};
use hdrhistogram::Histogram;
use hdrhistogram::serialization::interval_log::{
    IntervalLogIterator, IntervalLogWriterBuilder, LogEntry, Tag,
};
use hdrhistogram::serialization::{Deserializer, V2DeflateSerializer};
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Tag of the intervals that are corrected for coordinated omission; raw ones have none.
const CORRECTED: &str = "corrected";
const LEGEND: &str = r#""StartTimestamp","Interval_Length","Interval_Max","Interval_Compressed_Histogram""#;

/// A standard HdrHistogram interval log (`.hlog`) of durations in ns.
///
/// Each interval stands there twice: raw without a tag, and with the tag `corrected`. Every append is one write,
/// so that a killed writer leaves at most one torn line at the end, which [`repair`](Self::repair) takes away.
#[derive(Debug)]
pub struct IntervalLog {
    path: PathBuf,
}

/// What an interval log holds, summed over its intervals.
#[derive(Debug)]
pub struct LogContents {
    /// Raw durations, ns.
    pub raw: Histogram<u64>,
    /// Durations corrected for coordinated omission, ns.
    pub corrected: Histogram<u64>,
}

/// Why an interval log could not be used.
#[derive(Debug, thiserror::Error)]
pub enum IntervalLogError {
    /// The file could not be read or written.
    #[error("{path}: {cause}")]
    File {
        /// Of the log.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// A line is not one of an interval log.
    #[error(
        "{path}:{line}: not a line of an HdrHistogram interval log; the file is damaged or of another kind"
    )]
    Line {
        /// Of the log.
        path: PathBuf,
        /// Where, counted from 1.
        line: usize,
    },
    /// An interval's histogram could not be decoded.
    #[error("{path}: interval {interval} is damaged: {cause}")]
    Interval {
        /// Of the log.
        path: PathBuf,
        /// Which one, counted from 1.
        interval: usize,
        /// What is wrong with it.
        cause: String,
    },
}

impl IntervalLog {
    /// The log at this place; a new file begins with its header, `started` being time 0 of its intervals.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn open(path: &Path, started: SystemTime) -> Result<Self, IntervalLogError> {
        let log = Self { path: path.to_owned() };
        if !path.exists() {
            let mut text = Vec::new();
            let mut serializer = V2DeflateSerializer::new();
            IntervalLogWriterBuilder::new()
                .add_comment("[Histogram log format version 1.3]")
                .add_comment("durations in ns; untagged: raw; Tag=corrected: for coordinated omission, 1 ms")
                .with_start_time(started)
                .with_base_time(started)
                .begin_log_with(&mut text, &mut serializer)
                .map_err(|cause| log.file_error(cause))?;
            text.extend_from_slice(format!("{LEGEND}\n").as_bytes());
            log.append_bytes(&text)?;
        }
        Ok(log)
    }

    /// Appends one interval; one without values is left out.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn append(
        &self,
        interval: &Histogram<u64>,
        start: Duration,
        length: Duration,
    ) -> Result<(), IntervalLogError> {
        if interval.is_empty() {
            return Ok(());
        }
        let mut text = Vec::new();
        let mut serializer = V2DeflateSerializer::new();
        let mut write = || {
            let mut writer = IntervalLogWriterBuilder::new()
                .begin_log_with(&mut text, &mut serializer)
                .map_err(|cause| cause.to_string())?;
            writer.write_histogram(interval, start, length, None).map_err(|cause| cause.to_string())?;
            let corrected = interval.clone_correct(INTERVAL_NS);
            writer
                .write_histogram(&corrected, start, length, Tag::new(CORRECTED))
                .map_err(|cause| cause.to_string())
        };
        write().map_err(|cause| self.file_error(std::io::Error::other(cause)))?;
        self.append_bytes(&text)
    }

    /// Cuts off a line that a killed writer could not finish.
    ///
    /// # Errors
    /// The file cannot be read or written.
    pub fn repair(path: &Path) -> Result<(), IntervalLogError> {
        let error = |cause| IntervalLogError::File { path: path.to_owned(), cause };
        let text = read_within(path, LONGEST_LOG).map_err(error)?;
        let whole = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        if whole < text.len() {
            let file = OpenOptions::new().write(true).open(path).map_err(error)?;
            file.set_len(whole as u64).map_err(error)?;
        }
        Ok(())
    }

    /// Sums all intervals of a log.
    ///
    /// # Errors
    /// The file cannot be read, or a line or an interval of it is damaged.
    pub fn read(path: &Path) -> Result<LogContents, IntervalLogError> {
        let text = read_within(path, LONGEST_LOG)
            .map_err(|cause| IntervalLogError::File { path: path.to_owned(), cause })?;
        let line_of = |offset: usize| text[..offset].iter().filter(|&&byte| byte == b'\n').count() + 1;
        if !text.starts_with(b"#") {
            return Err(IntervalLogError::Line { path: path.to_owned(), line: 1 });
        }
        let mut contents = LogContents { raw: histogram(), corrected: histogram() };
        let mut intervals = 0;
        for entry in IntervalLogIterator::new(&text) {
            let entry = entry.map_err(|error| {
                let hdrhistogram::serialization::interval_log::LogIteratorError::ParseError { offset } =
                    error;
                IntervalLogError::Line { path: path.to_owned(), line: line_of(offset) }
            })?;
            let LogEntry::Interval(interval) = entry else { continue };
            intervals += 1;
            let corrected = interval.tag().is_some_and(|tag| tag.as_str() == CORRECTED);
            let sum = if corrected { &mut contents.corrected } else { &mut contents.raw };
            decode(interval.encoded_histogram())
                .and_then(|histogram| sum.add(histogram).map_err(|cause| cause.to_string()))
                .map_err(|cause| IntervalLogError::Interval {
                    path: path.to_owned(),
                    interval: intervals,
                    cause,
                })?;
        }
        Ok(contents)
    }

    fn append_bytes(&self, bytes: &[u8]) -> Result<(), IntervalLogError> {
        let file = OpenOptions::new().append(true).create(true).open(&self.path);
        file.and_then(|mut file| file.write_all(bytes)).map_err(|cause| self.file_error(cause))
    }

    fn file_error(&self, cause: std::io::Error) -> IntervalLogError {
        IntervalLogError::File { path: self.path.clone(), cause }
    }
}

fn decode(text: &str) -> Result<Histogram<u64>, String> {
    let bytes = base64::engine::general_purpose::STANDARD.decode(text).map_err(|cause| cause.to_string())?;
    Deserializer::new().deserialize(&mut bytes.as_slice()).map_err(|cause| cause.to_string())
}
