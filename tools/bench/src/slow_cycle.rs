use coact_messages::Pulse;
use serde::Serialize;

/// A cycle that took long from the sensors to the command, and what each stage did in it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SlowCycle {
    /// The cycle, ms from the start of the run.
    pub cycle: u64,
    /// From the sensor sample to the command, ns.
    pub end_to_end_ns: u64,
    /// The stages that published in it, in the order of the chain.
    pub stages: Vec<StageTimes>,
}

/// When a stage did what in a cycle, ns after the cycle's release.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StageTimes {
    /// Its process.
    pub process: String,
    /// How often it had been restarted.
    pub generation: u32,
    /// When it was due.
    pub due_ns: u64,
    /// When it started.
    pub started_ns: u64,
    /// When it published.
    pub published_ns: u64,
}

impl StageTimes {
    /// What a pulse tells.
    pub(crate) fn of(process: &str, pulse: &Pulse) -> Self {
        let after = |stamp: u64| stamp.saturating_sub(pulse.released_ns);
        Self {
            process: process.to_owned(),
            generation: pulse.header.generation,
            due_ns: after(pulse.scheduled_ns),
            started_ns: after(pulse.started_ns),
            published_ns: after(pulse.header.published_ns),
        }
    }
}
