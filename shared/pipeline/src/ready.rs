use serde::{Deserialize, Serialize};

/// Environment variable in which the supervisor tells a process its generation; absent: 0.
pub const GENERATION_VARIABLE: &str = "COACT_GENERATION";

/// What a process reports when it is ready to run: in `<run>/ready/<name>.<generation>.json`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ready {
    /// Its name in the process table.
    pub process: String,
    /// How often it was restarted in this run; 0 for the first start.
    pub generation: u32,
    /// Its process id.
    pub pid: u32,
    /// When it was started, clock ticks after boot ([`ProcessStat`](crate::ProcessStat)): a successor of the supervisor knows
    /// by it that the process id has not come to mean another process.
    #[serde(default)]
    pub started: u64,
    /// Id of its sentinel, a thread that ends as soon as the process does; 0 without one. The last thread to end still gives the
    /// memory back, for milliseconds.
    #[serde(default)]
    pub sentinel: u32,
    /// Scheduling class obtained: "SCHED_FIFO" or "SCHED_OTHER".
    pub scheduler: String,
    /// Real-time priority obtained; 0 for SCHED_OTHER.
    pub priority: u8,
    /// Core to which it is pinned, if it is.
    pub core: Option<usize>,
    /// True if all its present and future memory is locked.
    pub memory_locked: bool,
    /// Everything that the process table wants and the machine refused, each with the reason.
    pub why_not: Vec<String>,
    /// True if it resumed from its predecessor's checkpoint.
    pub resumed: bool,
}
