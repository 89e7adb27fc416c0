//! Latency histograms by name, and the deadline accounts beside them.

use crate::latencies::{logs, read_accounts};
use crate::{Account, IntervalLog, Lapse, LatencyError, Recorder};
use coact_messages::Pulse;
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the histogram from sensor stamp to command.
pub const END_TO_END: &str = "end-to-end";

/// Where a process stands in the chain: what must be known to name its figures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// Name of the process.
    pub process: String,
    /// Name of the process whose message starts its cycle, if one does.
    pub input_from: Option<String>,
    /// It publishes the command: the chain's end.
    pub last: bool,
}

/// Latency histograms and deadline accounts of all processes.
#[derive(Debug, Default)]
pub struct Figures {
    links: Vec<Link>,
    recorders: BTreeMap<String, Recorder>,
    accounts: BTreeMap<String, Account>,
}

impl Figures {
    /// Of processes that stand in the chain in this way; nothing is recorded yet.
    pub fn new(links: Vec<Link>) -> Self {
        Self { links, ..Self::default() }
    }

    /// Reads what a monitor has written into a folder of interval logs.
    ///
    /// # Errors
    /// A file cannot be read or is damaged.
    pub fn load(folder: &Path) -> Result<Self, LatencyError> {
        let error = |cause| LatencyError::File { path: folder.to_owned(), cause };
        let mut recorders = BTreeMap::new();
        for path in logs(folder).map_err(error)? {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            recorders.insert(name, Recorder::resume(IntervalLog::read(&path)?.raw));
        }
        Ok(Self { links: Vec::new(), recorders, accounts: read_accounts(folder)? })
    }

    /// The same, for processes that stand in the chain in this way.
    pub fn with_links(self, links: Vec<Link>) -> Self {
        Self { links, ..self }
    }

    /// Adds one cycle of a process and gives the lapses that it brought; none for one that was added before.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) -> Lapse {
        if self.accounts.get(process).is_some_and(|account| !account.is_new(pulse)) {
            return Lapse::default();
        }
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

    /// Histograms by name: [`END_TO_END`], and what [`wakeup_name`], [`execution_name`] and [`hop_name`] give.
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

    pub(crate) fn recorders_mut(&mut self) -> &mut BTreeMap<String, Recorder> {
        &mut self.recorders
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
