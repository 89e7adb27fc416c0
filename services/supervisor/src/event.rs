/// One line of `supervisor.jsonl`: what happened to a process, and when.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Event {
    /// When it was seen or done: ns of `CLOCK_MONOTONIC`. Of a death: detection. Of an injection: just before it.
    pub at_ns: u64,
    /// What happened.
    pub event: EventKind,
    /// Name of the process.
    pub process: String,
    /// How often the process had been restarted before.
    pub generation: u32,
    /// Process id.
    pub pid: u32,
    /// Name of the injected fault, if one was.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub fault: Option<String>,
    /// Why: how it died, why it was given up.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
}

/// What may happen to a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// Started for the first time.
    Started,
    /// Reported ready.
    Ready,
    /// Found dead.
    Died,
    /// Started again after a death.
    Restarted,
    /// Not started again: the restart intensity is exhausted.
    GaveUp,
    /// About to get a fault injected.
    Injected,
    /// Ended because the run ended.
    Stopped,
}
