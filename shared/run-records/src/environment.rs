use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Where a report was taken: without it, latencies mean nothing.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Environment {
    /// Name and release of the kernel.
    pub kernel: String,
    /// Preemption model of the kernel, as it was built or says of itself.
    pub preemption: String,
    /// Frequency governor of the first core; "none" where the kernel governs nothing.
    pub governor: String,
    /// Cores of the machine that are online.
    pub cores: usize,
    /// Every real-time process has all its memory locked.
    pub memory_locked: bool,
    /// For each process, the scheduling class that it obtained, with priority and core.
    pub schedulers: BTreeMap<String, String>,
    /// How punctual the machine itself was meanwhile; none in lockstep, where no clock runs.
    pub machine: Option<MachineReport>,
}

/// What the latency probe saw: a thread that only wakes up once a period, beside the pipeline's first stage.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct MachineReport {
    /// How often it woke up.
    pub wakeups: u64,
    /// How often a whole period late, or later.
    pub late: u64,
    /// 99.9 % of its wake-ups were no later than this, ns.
    pub p999_ns: u64,
    /// The greatest wake-up lateness, ns.
    pub longest_ns: u64,
}
