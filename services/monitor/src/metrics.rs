//! Latency histograms by name, and the counters of each process.

use crate::latencies::{logs, read_counters};
use crate::{CycleFindings, DurationRecorder, IntervalLog, LatencyError, PipelineNode, ProcessCounters};
use coact_messages::{Pulse, topic};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

/// Name of the histogram from sensor stamp to command.
pub const END_TO_END: &str = "end-to-end";

/// Latency histograms and counters of all processes.
#[derive(Debug, Default)]
pub struct Metrics {
    nodes: Vec<PipelineNode>,
    recorders: BTreeMap<String, DurationRecorder>,
    counters: BTreeMap<String, ProcessCounters>,
    /// How old a sensor sample may be for what descends from it to be good, ns.
    fresh_ns: u64,
}

impl Metrics {
    /// Of these processes; nothing is recorded yet. What descends from a sensor sample older than `fresh` is no good output.
    pub fn new(nodes: Vec<PipelineNode>, fresh: Duration) -> Self {
        Self::default().with_nodes(nodes, fresh)
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
            recorders.insert(name, DurationRecorder::resume(IntervalLog::read(&path)?.raw));
        }
        Ok(Self { recorders, counters: read_counters(folder)?, ..Self::default() })
    }

    /// The same, to be continued with these processes.
    pub fn with_nodes(self, nodes: Vec<PipelineNode>, fresh: Duration) -> Self {
        Self { nodes, fresh_ns: fresh.as_nanos() as u64, ..self }
    }

    /// Adds one cycle of a process and gives what it tells; nothing for one that was added before. Of a standby only what its
    /// stage's readers got by it, and its own counters. To be added in the order of the outputs that they tell of.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) -> CycleFindings {
        if self.counters.get(process).is_some_and(|counters| !counters.is_new(pulse)) {
            return CycleFindings::default();
        }
        let stage = topic::stage(process);
        if stage != process {
            self.counters.entry(stage.to_owned()).or_default().add_of_standby(pulse, self.fresh_ns);
            return self.counters.entry(process.to_owned()).or_default().add(pulse, self.fresh_ns);
        }
        let node = self.nodes.iter().find(|node| node.process == process);
        let from = node.and_then(|node| node.input_from.clone());
        let last = node.is_some_and(|node| node.last);
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
        self.counters.entry(process.to_owned()).or_default().add(pulse, self.fresh_ns)
    }

    /// Histograms by name: [`END_TO_END`], and what [`wakeup_name`], [`execution_name`] and [`hop_name`] give.
    pub fn histograms(&self) -> &BTreeMap<String, DurationRecorder> {
        &self.recorders
    }

    /// Counters by process.
    pub fn counters(&self) -> &BTreeMap<String, ProcessCounters> {
        &self.counters
    }

    /// The processes, and where each gets its input.
    pub fn nodes(&self) -> &[PipelineNode] {
        &self.nodes
    }

    pub(crate) fn recorders_mut(&mut self) -> &mut BTreeMap<String, DurationRecorder> {
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
