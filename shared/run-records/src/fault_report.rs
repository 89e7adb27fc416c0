use crate::{Event, FaultEvent};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One fault.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct FaultReport {
    /// Name of the process.
    pub process: String,
    /// What was done to it, or how it died.
    pub fault: String,
    /// Instant of the last good output before the fault, s from the start of the run.
    pub at_s: f64,
    /// From the fault until the supervisor saw it; none when it saw nothing.
    pub detected_ms: Option<f64>,
    /// Recovery: from the fault until the first good output; none when there was none.
    pub recovered_ms: Option<f64>,
    /// Cycles without timely output of all survivors between fault and recovery.
    pub survivors_missed: u64,
    /// The same, by process.
    pub survivors_missed_by: BTreeMap<String, u64>,
    /// For how long at most the machine itself did nothing for real-time threads meanwhile; 0 when never for half a period.
    #[serde(default)]
    pub machine_late_ms: f64,
}

impl FaultReport {
    /// All faults among the events of a run that began at `start_ns`, ns of `CLOCK_MONOTONIC`.
    pub fn all(events: &[Event], start_ns: u64) -> Vec<Self> {
        let faults = events.iter().filter_map(|event| match event {
            Event::Fault(fault) => Some(fault),
            _ => None,
        });
        faults.map(|fault| Self::new(fault, start_ns)).collect()
    }

    fn new(fault: &FaultEvent, start_ns: u64) -> Self {
        Self {
            process: fault.process.clone(),
            fault: fault.fault.clone(),
            at_s: fault.at_ns.saturating_sub(start_ns) as f64 / 1e9,
            detected_ms: fault.detected_ms,
            recovered_ms: fault.recovered_ms,
            survivors_missed: fault.survivors_missed.values().sum(),
            survivors_missed_by: fault.survivors_missed.clone(),
            machine_late_ms: fault.machine_late_ms,
        }
    }
}
