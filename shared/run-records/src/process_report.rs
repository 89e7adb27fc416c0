use crate::{OutageReport, Percentiles};
use serde::{Deserialize, Serialize};

/// How regular one process was.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ProcessReport {
    /// Cycles that published an output.
    pub cycles: u64,
    /// Deadline misses.
    pub missed: u64,
    /// Longest run of them.
    pub longest_miss_run: u64,
    /// Periods without a cycle, because the one before overran.
    pub skipped: u64,
    /// Cycles of which the monitor saw no pulse; what was missed in them is known from the counters of the next one.
    pub unseen: u64,
    /// How often it was restarted.
    pub restarts: u32,
    /// Cycles without timely output, over cycles due.
    pub outage: OutageReport,
    /// Wake-up lateness: actual minus scheduled start.
    pub wakeup_ns: Percentiles,
    /// Execution time: from start to publication.
    pub execution_ns: Percentiles,
}
