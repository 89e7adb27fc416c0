use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A fault of one process, and the recovery from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct FaultEvent {
    /// Name of the process.
    pub process: String,
    /// The injected fault's name; of a death that nobody asked for: how it died.
    pub fault: String,
    /// Instant of the last good output before the fault, ns of `CLOCK_MONOTONIC`; of a process without pulses: when the fault
    /// was injected, or seen.
    pub at_ns: u64,
    /// From the fault until the supervisor saw it; none when it saw nothing.
    pub detected_ms: Option<f64>,
    /// From the fault until the first good output (of the replacement); none when there was none.
    pub recovered_ms: Option<f64>,
    /// Cycles without timely output of each surviving process between fault and recovery.
    pub survivors_missed: BTreeMap<String, u64>,
    /// For how long at most the machine itself did nothing for real-time threads meanwhile; 0 when never for half a period.
    #[serde(default)]
    pub machine_late_ms: f64,
}

impl FaultEvent {
    /// Instant up to which all that happened to the process belongs to this fault: its recovery, or its detection when there was
    /// none; ns of `CLOCK_MONOTONIC`.
    pub fn settled_ns(&self) -> u64 {
        let settled_ms = self.recovered_ms.or(self.detected_ms).unwrap_or(0.0);
        // Rounded up: the instant itself is included.
        self.at_ns + (settled_ms * 1e6).ceil() as u64 + 1
    }
}
