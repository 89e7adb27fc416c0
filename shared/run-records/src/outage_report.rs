use serde::{Deserialize, Serialize};

/// How long something that is due once a period was missing. A cycle lasts 1 ms.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct OutageReport {
    /// Cycles that were due, from the start of the run until its end was requested.
    pub due: u64,
    /// Cycles of them without timely good output: late, skipped, or with nobody alive to make it.
    pub without_output: u64,
    /// The longest run of them, across restarts, cycles.
    pub longest: u64,
    /// When the last good output before that run was made, ms from the start of the run.
    pub longest_from_ms: u64,
}
