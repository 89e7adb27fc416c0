use coact_messages::Pulse;
use coact_monitor::metrics::END_TO_END;
use coact_monitor::{DurationRecorder, Metrics, PipelineNode, percentiles};
use coact_pipeline::{Pipeline, Trigger};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::time::Duration;

/// How punctual the processes of a run are, from their pulses.
#[derive(Debug)]
pub struct Machine {
    metrics: Metrics,
    /// Name of each process of the table, and whether it has cycles.
    processes: Vec<(String, bool)>,
    /// Cycle of the newest pulse of each process.
    newest: BTreeMap<String, u64>,
}

/// A process whose newest pulse is so many cycles behind is down, or hangs.
const SILENT: u64 = 250;
/// Points of a percentile curve: each halves the share of durations that are longer.
const POINTS: i32 = 20;

impl Machine {
    /// Of these processes; what descends from a sensor sample older than `fresh` is no good output.
    pub fn new(pipeline: &Pipeline, fresh: Duration) -> Self {
        let processes = pipeline.processes.iter();
        let processes = processes.map(|entry| (entry.name.clone(), entry.trigger != Trigger::None));
        let metrics = Metrics::new(PipelineNode::all(pipeline), fresh);
        Self { metrics, processes: processes.collect(), newest: BTreeMap::new() }
    }

    /// Adds one cycle of a process.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) {
        self.metrics.pulse(process, pulse);
        match self.newest.get_mut(process) {
            Some(newest) => *newest = pulse.header.cycle.max(*newest),
            None => drop(self.newest.insert(process.to_owned(), pulse.header.cycle)),
        }
    }

    /// What a page is told at `cycle`.
    pub fn to_json(&self, cycle: u64) -> Value {
        let durations = |prefix: &str| -> Vec<Value> {
            let histograms = self.metrics.histograms().iter();
            let named = histograms.filter_map(|(name, of)| Some((name.strip_prefix(prefix)?, of)));
            named.map(|(name, of)| distribution(&name.replace('.', " \u{2192} "), of)).collect()
        };
        let processes =
            self.processes.iter().map(|(name, has_cycles)| self.process(name, *has_cycles, cycle));
        json!({
            "kind": "machine",
            "at_ms": cycle,
            "cycles": self.metrics.counters().values().map(|counters| counters.cycles).max(),
            "end_to_end": self.metrics.histograms().get(END_TO_END).map(|of| distribution("end to end", of)),
            "hops": durations("hop."),
            "wakeups": durations("wakeup."),
            "processes": processes.collect::<Vec<_>>(),
        })
    }

    fn process(&self, name: &str, has_cycles: bool, cycle: u64) -> Value {
        let Some(counters) = self.metrics.counters().get(name) else {
            let state = if has_cycles { "no pulse" } else { "own pace" };
            return json!({ "name": name, "state": state });
        };
        let newest = self.newest.get(name).copied().unwrap_or_default();
        let outage = counters.outage.until(newest);
        json!({
            "name": name,
            "state": if cycle > newest + SILENT { "down" } else { "runs" },
            "restarts": counters.restarts,
            "missed": counters.missed,
            "cycles": counters.cycles,
            "outage_cycles": outage.without_output,
        })
    }
}

fn distribution(name: &str, recorder: &DurationRecorder) -> Value {
    let (histogram, found) = (recorder.total(), percentiles(recorder.total()));
    let us = |ns: u64| ns as f64 / 1e3;
    let curve = (0..=POINTS).map(|point| 100.0 * (1.0 - 0.5_f64.powi(point)));
    // Beyond the last duration the curve would only go on as it is.
    let told = curve.filter(|percentile| (1.0 - percentile / 100.0) * histogram.len() as f64 >= 0.5);
    let curve = told.map(|percentile| json!([percentile, us(histogram.value_at_percentile(percentile))]));
    json!({
        "name": name,
        "count": histogram.len(),
        "p50_us": us(found.p50),
        "p99_us": us(found.p99),
        "p999_us": us(found.p999),
        "max_us": us(found.max),
        "curve": curve.collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::path::Path;

    #[test]
    fn a_process_that_falls_silent_is_down_and_its_durations_are_told() {
        let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/pipeline.toml");
        let mut machine = Machine::new(&Pipeline::load(&table).unwrap(), Duration::from_millis(30));
        for cycle in 0..100 {
            let mut pulse = Pulse { scheduled_ns: 1_000, started_ns: 4_000, ..Pulse::default() };
            (pulse.header.cycle, pulse.header.sequence) = (cycle, cycle);
            machine.pulse("world", &pulse);
        }
        let state = |told: &Value, name: &str| {
            let processes = told["processes"].as_array().unwrap();
            processes.iter().find(|process| process["name"] == name).unwrap()["state"].clone()
        };
        let told = machine.to_json(120);
        assert_eq!((state(&told, "world"), state(&told, "fields")), ("runs".into(), "no pulse".into()));
        assert_eq!(state(&told, "voice"), "own pace");
        assert_eq!(state(&machine.to_json(600), "world"), "down");
        let wakeups = told["wakeups"].as_array().unwrap();
        assert_eq!((&wakeups[0]["name"], wakeups[0]["count"].as_u64()), (&"world".into(), Some(100)));
        assert!((wakeups[0]["p50_us"].as_f64().unwrap() - 3.0).abs() < 0.1);
    }
}
