use crate::{Account, Figures, IntervalLog, IntervalLogError, Lapse, Link};
use coact_messages::Pulse;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Name of the accounts' file, beside the interval logs.
const ACCOUNTS: &str = "accounts.json";

/// Latency histograms and deadline accounts of all processes, kept in a folder of the report.
#[derive(Debug)]
pub struct Latencies {
    folder: PathBuf,
    started: SystemTime,
    figures: Figures,
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
        for path in logs(folder).map_err(error)? {
            IntervalLog::repair(&path)?;
        }
        let figures = Figures::load(folder)?.with_links(links);
        let written = SystemTime::now().duration_since(started).unwrap_or_default();
        Ok(Self { folder: folder.to_owned(), started, figures, written })
    }

    /// Adds one cycle of a process and gives the lapses that it brought; none for one that was added before.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) -> Lapse {
        self.figures.pulse(process, pulse)
    }

    /// Writes what came since the last call; about once a second, and at the end.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&mut self) -> Result<(), LatencyError> {
        let now = self.started.elapsed().unwrap_or_default();
        let length = now.saturating_sub(self.written);
        for (name, recorder) in self.figures.recorders_mut() {
            let log = IntervalLog::open(&self.folder.join(format!("{name}.hlog")), self.started)?;
            log.append(&recorder.take_interval(), self.written, length)?;
        }
        self.written = now;
        write_accounts(&self.folder, self.figures.accounts())
    }

    /// All figures of the run so far.
    pub fn figures(&self) -> &Figures {
        &self.figures
    }
}

/// All interval logs of a folder, by name.
pub(crate) fn logs(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
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

/// The accounts that stand beside a folder's logs; none where none were written yet.
pub(crate) fn read_accounts(folder: &Path) -> Result<BTreeMap<String, Account>, LatencyError> {
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
