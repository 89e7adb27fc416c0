use crate::{BenchError, Load, SlowCycle, SlowCycles};
use coact_monitor::{Metrics, metrics, percentiles};
use coact_run_records::{Environment, FaultReport, OutageReport, Percentiles, Summary};
use hdrhistogram::Histogram;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// What a bench found. Durations are ns.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct LatencyReport {
    /// What else the machine had to do.
    pub load: &'static str,
    /// The machine, with the lateness of its idle thread.
    pub environment: Environment,
    /// From sensor sample to command.
    pub end_to_end: Percentiles,
    /// The same in cycles in which every stage published: without those in which one was dead.
    pub end_to_end_whole: Percentiles,
    /// The 99.9th percentile of the latter over that of the idle thread's lateness; none without such a thread.
    pub end_to_end_over_idle: Option<f64>,
    /// From one stage to the next, by the name of the edge.
    pub hops: BTreeMap<String, Percentiles>,
    /// The payload of the first of them through iceoryx2 alone.
    pub raw_hop: Percentiles,
    /// The median of each hop over the raw one's.
    pub hop_over_raw: BTreeMap<String, f64>,
    /// Cycles without a timely command.
    pub command_outage: OutageReport,
    /// Each kill, and the recovery from it.
    pub kills: Vec<FaultReport>,
    /// The slowest cycles, the slowest first.
    pub slowest: Vec<SlowCycle>,
}

/// The report, and what its curves are drawn from.
#[derive(Debug)]
pub struct Measured {
    /// The report.
    pub report: LatencyReport,
    /// Histograms by name: those of the run's own report, and the raw hop's.
    pub histograms: BTreeMap<String, Histogram<u64>>,
}

/// Name of the raw hop's histogram.
const RAW: &str = "hop.raw";

impl Measured {
    /// Reads what the run's monitor has measured, and sets it beside the raw hop and what the pulses told. The timer releases
    /// `first`: that it receives the last command then is no hop.
    ///
    /// # Errors
    /// The run has left no report.
    pub fn read(
        report: &Path,
        load: Load,
        first: &str,
        raw: Histogram<u64>,
        cycles: SlowCycles,
    ) -> Result<Self, BenchError> {
        let (slowest, whole) = cycles.finish();
        let summary = Summary::read(report)?;
        let recorded = Metrics::load(&report.join("latency"))?;
        let totals =
            recorded.histograms().iter().map(|(name, recorder)| (name.clone(), recorder.total().clone()));
        let mut histograms: BTreeMap<_, _> = totals.collect();
        let raw_hop = percentiles(&raw);
        let hops: BTreeMap<_, _> = histograms
            .iter()
            .filter(|(name, _)| name.starts_with("hop.") && !name.ends_with(&format!(".{first}")))
            .map(|(name, histogram)| (name.clone(), percentiles(histogram)))
            .collect();
        let end_to_end = histograms.get(metrics::END_TO_END).map(percentiles).unwrap_or_default();
        let end_to_end_whole = percentiles(&whole);
        histograms.insert(RAW.to_owned(), raw);
        let report = LatencyReport {
            load: load.name(),
            end_to_end_over_idle: summary
                .environment
                .machine
                .and_then(|machine| ratio(end_to_end_whole.p999, machine.p999_ns)),
            end_to_end,
            end_to_end_whole,
            hop_over_raw: hops
                .iter()
                .filter_map(|(name, hop)| Some((name.clone(), ratio(hop.p50, raw_hop.p50)?)))
                .collect(),
            hops,
            raw_hop,
            environment: summary.environment,
            command_outage: summary.command_outage,
            kills: summary.faults,
            slowest,
        };
        Ok(Self { report, histograms })
    }
}

/// None of nothing.
fn ratio(one: u64, other: u64) -> Option<f64> {
    (one > 0 && other > 0).then(|| one as f64 / other as f64)
}
