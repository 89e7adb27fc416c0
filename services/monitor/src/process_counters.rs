use coact_messages::{Header, Pulse};

/// What one process missed over the whole run, its restarts included.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct ProcessCounters {
    /// Cycles that published an output.
    pub cycles: u64,
    /// Deadline misses.
    pub missed: u64,
    /// Longest run of misses in consecutive cycles.
    pub longest_miss_run: u64,
    /// Cycles that ran on an input that was used before.
    pub stale: u64,
    /// Cycles skipped because the one before overran.
    pub skipped: u64,
    /// How often the process was restarted.
    pub restarts: u32,
    /// Misses at the end of what was seen so far, without a timely cycle in between.
    run: u64,
    /// PulseCounters of the newest pulse.
    last: Option<PulseCounters>,
}

/// The counters that a pulse carries: they start from 0 in each generation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
struct PulseCounters {
    generation: u32,
    sequence: u64,
    missed: u64,
    stale: u64,
    skipped: u64,
}

/// What one cycle added to the counters of its process.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CycleMisses {
    /// Deadline misses.
    pub missed: u64,
    /// Skipped cycles.
    pub skipped: u64,
}

impl ProcessCounters {
    /// False for a pulse that was counted before: a reader that connects gets the newest one once more.
    pub fn is_new(&self, pulse: &Pulse) -> bool {
        let Header { generation, sequence, .. } = pulse.header;
        self.last.is_none_or(|last| (generation, sequence) > (last.generation, last.sequence))
    }

    /// Adds a new cycle, and gives what was missed in it or since the one before.
    ///
    /// The counters in the pulse make up for pulses that were lost on the way. Misses among those count as one run: the
    /// longest that it may have been.
    pub fn add(&mut self, pulse: &Pulse) -> CycleMisses {
        let now = PulseCounters {
            generation: pulse.header.generation,
            sequence: pulse.header.sequence,
            missed: pulse.missed,
            stale: pulse.stale,
            skipped: pulse.skipped,
        };
        let same = self.last.filter(|last| last.generation == now.generation && last.sequence < now.sequence);
        // A reader that connects late counts from there; a replacement has counted from its own start.
        let connected_late = self.last.is_none() && now.sequence > 0;
        let zero = if connected_late { now } else { PulseCounters::default() };
        let before = same.unwrap_or(PulseCounters { sequence: now.sequence.saturating_sub(1), ..zero });
        let missed = now.missed.saturating_sub(before.missed);
        let skipped = now.skipped.saturating_sub(before.skipped);
        self.cycles += now.sequence.saturating_sub(before.sequence).max(1);
        self.missed += missed;
        self.stale += now.stale.saturating_sub(before.stale);
        self.skipped += skipped;
        self.restarts = self.restarts.max(now.generation);
        self.run = if missed == 0 { 0 } else { self.run + missed };
        self.longest_miss_run = self.longest_miss_run.max(self.run);
        self.last = Some(now);
        CycleMisses { missed, skipped }
    }
}
