use crate::{CycleFindings, IntervalLog, IntervalLogError, Metrics, PipelineNode, ProcessCounters};
use coact_messages::Pulse;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Name of the counters' file, beside the interval logs.
const COUNTERS: &str = "counters.json";

/// Latency histograms and counters of all processes, written into a folder of the report.
#[derive(Debug)]
pub struct Latencies {
    folder: PathBuf,
    started: SystemTime,
    metrics: Metrics,
    /// End of the last interval written, counted from `started`.
    written: Duration,
}

/// Why latencies could not be written or read back.
#[derive(Debug, thiserror::Error)]
pub enum LatencyError {
    /// An interval log.
    #[error(transparent)]
    Log(#[from] IntervalLogError),
    /// The folder or the counters' file.
    #[error("{path}: {cause}")]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said, or what is wrong in it.
        cause: std::io::Error,
    },
}

impl Latencies {
    /// Writes logs into `folder`; goes on with those that a killed predecessor left there.
    ///
    /// `started` is the start of the run: time 0 of the logs' intervals. `fresh`: see [`Metrics::new`].
    ///
    /// # Errors
    /// The folder cannot be made, or what it holds cannot be read.
    pub fn open(
        folder: &Path,
        nodes: Vec<PipelineNode>,
        fresh: Duration,
        started: SystemTime,
    ) -> Result<Self, LatencyError> {
        let error = |cause| LatencyError::File { path: folder.to_owned(), cause };
        std::fs::create_dir_all(folder).map_err(error)?;
        for path in logs(folder).map_err(error)? {
            IntervalLog::repair(&path)?;
        }
        let metrics = Metrics::load(folder)?.with_nodes(nodes, fresh);
        let written = SystemTime::now().duration_since(started).unwrap_or_default();
        Ok(Self { folder: folder.to_owned(), started, metrics, written })
    }

    /// Adds one cycle of a process and gives what it tells; nothing for one that was added before.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) -> CycleFindings {
        self.metrics.pulse(process, pulse)
    }

    /// Writes what came since the last call; about once a second, and at the end.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&mut self) -> Result<(), LatencyError> {
        let now = self.started.elapsed().unwrap_or_default();
        let length = now.saturating_sub(self.written);
        for (name, recorder) in self.metrics.recorders_mut() {
            let log = IntervalLog::open(&self.folder.join(format!("{name}.hlog")), self.started)?;
            log.append(&recorder.take_interval(), self.written, length)?;
        }
        self.written = now;
        write_counters(&self.folder, self.metrics.counters())
    }

    /// All metrics of the run so far.
    pub fn metrics(&self) -> &Metrics {
        &self.metrics
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

/// The counters that stand beside a folder's logs; none where none were written yet.
pub(crate) fn read_counters(folder: &Path) -> Result<BTreeMap<String, ProcessCounters>, LatencyError> {
    let path = folder.join(COUNTERS);
    match coact_input_file::read_text(&path) {
        Ok(text) => serde_json::from_str(&text)
            .map_err(|cause| LatencyError::File { path, cause: std::io::Error::other(cause) }),
        Err(cause) if cause.kind() == std::io::ErrorKind::NotFound => Ok(BTreeMap::new()),
        Err(cause) => Err(LatencyError::File { path, cause }),
    }
}

fn write_counters(folder: &Path, counters: &BTreeMap<String, ProcessCounters>) -> Result<(), LatencyError> {
    let path = folder.join(COUNTERS);
    replace(&path, counters).map_err(|cause| LatencyError::File { path, cause })
}

/// Replaces a file of JSON as a whole, so that a kill in between leaves the old one.
pub(crate) fn replace(path: &Path, value: &impl serde::Serialize) -> std::io::Result<()> {
    let draft = path.with_extension("json.new");
    std::fs::write(&draft, serde_json::to_vec_pretty(value)?)?;
    std::fs::rename(&draft, path)
}
