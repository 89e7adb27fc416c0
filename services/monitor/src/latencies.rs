//! Latency histograms by name, and the deadline accounts beside them.

use crate::{Account, IntervalLog, IntervalLogError, Lapse, Recorder};
use coact_messages::Pulse;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Name of the accounts' file, beside the interval logs.
const ACCOUNTS: &str = "accounts.json";
/// Name of the histogram from sensor stamp to command.
pub const END_TO_END: &str = "end-to-end";

/// Where a process stands in the chain: what the monitor must know to name its figures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// Name of the process.
    pub process: String,
    /// Name of the process whose message starts its cycle; none for the first in the chain.
    pub input_from: Option<String>,
    /// It publishes the command: the chain's end.
    pub last: bool,
}

/// Latency histograms and deadline accounts of all processes, kept in a folder of the report.
#[derive(Debug)]
pub struct Latencies {
    folder: PathBuf,
    started: SystemTime,
    links: Vec<Link>,
    recorders: BTreeMap<String, Recorder>,
    accounts: BTreeMap<String, Account>,
    /// End of the last interval written, counted from `started`.
    written: Duration,
}

/// Why latencies could not be kept or read back.
#[derive(Debug, thiserror::Error)]
pub enum LatencyError {
    /// An interval log.
    #[error(transparent)]
    Log(#[from] IntervalLogError),
    /// The folder or the accounts' file.
    #[error("{path}: {cause}")]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said, or what is wrong in it.
        cause: std::io::Error,
    },
}

impl Latencies {
    /// Keeps logs in `folder`; goes on with those that a killed predecessor left there.
    ///
    /// `started` is the start of the run: time 0 of the logs' intervals.
    ///
    /// # Errors
    /// The folder cannot be made, or what it holds cannot be read.
    pub fn open(folder: &Path, links: Vec<Link>, started: SystemTime) -> Result<Self, LatencyError> {
        let error = |cause| LatencyError::File { path: folder.to_owned(), cause };
        std::fs::create_dir_all(folder).map_err(error)?;
        let mut recorders = BTreeMap::new();
        for path in logs(folder).map_err(error)? {
            IntervalLog::repair(&path)?;
            recorders.insert(log_name(&path), Recorder::resume(IntervalLog::read(&path)?.raw));
        }
        let accounts = read_accounts(folder)?;
        let written = SystemTime::now().duration_since(started).unwrap_or_default();
        Ok(Self { folder: folder.to_owned(), started, links, recorders, accounts, written })
    }

    /// Adds one cycle of a process and gives the lapses that it brought.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) -> Lapse {
        let link = self.links.iter().find(|link| link.process == process);
        let from = link.and_then(|link| link.input_from.clone());
        let last = link.is_some_and(|link| link.last);
        let published = pulse.header.published_ns;
        self.record(&wakeup_name(process), pulse.started_ns.saturating_sub(pulse.scheduled_ns));
        self.record(&execution_name(process), published.saturating_sub(pulse.started_ns));
        if let Some(from) = from.filter(|_| pulse.input_received_ns != 0) {
            let hop = pulse.input_received_ns.saturating_sub(pulse.input_published_ns);
            self.record(&hop_name(&from, process), hop);
        }
        if last && pulse.header.sensor_ns != 0 {
            self.record(END_TO_END, published.saturating_sub(pulse.header.sensor_ns));
        }
        self.accounts.entry(process.to_owned()).or_default().add(pulse)
    }

    /// Writes what came since the last call; about once a second, and at the end.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&mut self) -> Result<(), LatencyError> {
        let now = self.started.elapsed().unwrap_or_default();
        let length = now.saturating_sub(self.written);
        for (name, recorder) in &mut self.recorders {
            let log = IntervalLog::open(&self.folder.join(format!("{name}.hlog")), self.started)?;
            log.append(&recorder.take_interval(), self.written, length)?;
        }
        self.written = now;
        write_accounts(&self.folder, &self.accounts)
    }

    /// Histograms by name: [`END_TO_END`], and those that [`wakeup_name`], [`execution_name`] and [`hop_name`] give.
    pub fn histograms(&self) -> &BTreeMap<String, Recorder> {
        &self.recorders
    }

    /// Deadline accounts by process.
    pub fn accounts(&self) -> &BTreeMap<String, Account> {
        &self.accounts
    }

    /// How the processes stand in the chain.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    fn record(&mut self, name: &str, duration_ns: u64) {
        match self.recorders.get_mut(name) {
            Some(recorder) => recorder.record(duration_ns),
            None => self.recorders.entry(name.to_owned()).or_default().record(duration_ns),
        }
    }
}

/// Name of the histogram of a process's wake-up lateness.
pub fn wakeup_name(process: &str) -> String {
    format!("wakeup.{process}")
}

/// Name of the histogram of a process's execution time.
pub fn execution_name(process: &str) -> String {
    format!("execution.{process}")
}

/// Name of the histogram of an edge's hops.
pub fn hop_name(from: &str, to: &str) -> String {
    format!("hop.{from}.{to}")
}

/// All interval logs of a folder, by name.
///
/// # Errors
/// The folder cannot be read.
pub fn logs(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut logs = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "hlog") {
            logs.push(path);
        }
    }
    logs.sort();
    Ok(logs)
}

/// Name of the histogram that a log holds.
pub fn log_name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The accounts that stand beside a folder's logs; none where none were written yet.
///
/// # Errors
/// The file cannot be read, or is not what [`Latencies::write`] writes.
pub fn read_accounts(folder: &Path) -> Result<BTreeMap<String, Account>, LatencyError> {
    let path = folder.join(ACCOUNTS);
    match std::fs::read(&path) {
        Ok(text) => serde_json::from_slice(&text)
            .map_err(|cause| LatencyError::File { path, cause: std::io::Error::other(cause) }),
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => Ok(BTreeMap::new()),
        Err(cause) => Err(LatencyError::File { path, cause }),
    }
}

/// Replaces the file as a whole, so that a kill in between leaves the old one.
fn write_accounts(folder: &Path, accounts: &BTreeMap<String, Account>) -> Result<(), LatencyError> {
    let (path, draft) = (folder.join(ACCOUNTS), folder.join("accounts.json.new"));
    let written = serde_json::to_vec_pretty(accounts)
        .map_err(std::io::Error::from)
        .and_then(|text| std::fs::write(&draft, text))
        .and_then(|()| std::fs::rename(&draft, &path));
    written.map_err(|cause| LatencyError::File { path, cause })
}
