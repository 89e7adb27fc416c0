use crate::Outage;
use coact_messages::{Header, Pulse, Refusal};
use coact_period::PERIOD_NS;

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
    /// Cycles of which no pulse was seen; the counters of the next one tell what was missed in them.
    pub unseen: u64,
    /// How often the process was restarted.
    pub restarts: u32,
    /// Cycles without timely output.
    pub outage: Outage,
    /// Cycles without timely output that descends from a sensor sample young enough to be used.
    pub outage_on_fresh_data: Outage,
    /// Messages that it ignored, by the number of their [`Refusal`].
    #[serde(default)]
    pub refused: [u64; Refusal::COUNT],
    /// Sequence of the newest output that is accounted for, whoever told of it.
    #[serde(default)]
    newest_output: Option<u64>,
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
    #[serde(default)]
    refused: [u32; Refusal::COUNT],
}

/// What a pulse tells of its cycle and of those since the pulse before.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CycleFindings {
    /// Cycles without timely output.
    pub outage: u64,
    /// Cycles that had an output, but no pulse of theirs was seen.
    pub unseen: u64,
}

impl ProcessCounters {
    /// False for a pulse that was counted before: a reader that connects gets the newest one once more.
    pub fn is_new(&self, pulse: &Pulse) -> bool {
        let Header { generation, sequence, .. } = pulse.header;
        self.last.is_none_or(|last| (generation, sequence) > (last.generation, last.sequence))
    }

    /// Adds a new cycle, and gives what is found of it and of those since the one before. What descends from a sensor sample
    /// older than `fresh_ns` is no good output.
    ///
    /// The counters in the pulse make up for pulses that were lost on the way. Misses among those count as one run: the
    /// longest that it may have been.
    pub fn add(&mut self, pulse: &Pulse, fresh_ns: u64) -> CycleFindings {
        let now = PulseCounters {
            generation: pulse.header.generation,
            sequence: pulse.header.sequence,
            missed: pulse.missed,
            stale: pulse.stale,
            skipped: pulse.skipped,
            refused: pulse.refused,
        };
        let same = self.last.filter(|last| last.generation == now.generation && last.sequence < now.sequence);
        // A reader that connects late counts from there; a replacement has counted from its own start.
        let connected_late = self.last.is_none() && now.sequence > 0;
        let zero = if connected_late { now } else { PulseCounters::default() };
        let before = same.unwrap_or(PulseCounters { sequence: now.sequence.saturating_sub(1), ..zero });
        let missed = now.missed.saturating_sub(before.missed);
        let timely = self.timely_outputs(now);
        let unseen = self.unseen_outputs(now);
        self.cycles += now.sequence.saturating_sub(before.sequence).max(1);
        self.missed += missed;
        self.stale += now.stale.saturating_sub(before.stale);
        self.skipped += now.skipped.saturating_sub(before.skipped);
        self.unseen += unseen;
        for (refused, (now, before)) in self.refused.iter_mut().zip(now.refused.iter().zip(before.refused)) {
            *refused += u64::from(now.saturating_sub(before));
        }
        self.restarts = self.restarts.max(now.generation);
        self.run = if missed == 0 { 0 } else { self.run + missed };
        self.longest_miss_run = self.longest_miss_run.max(self.run);
        self.last = Some(now);
        self.newest_output = Some(now.sequence);
        CycleFindings { outage: self.account(pulse, timely, fresh_ns), unseen }
    }

    /// Adds a cycle of the process's standby, which tells of the same outputs: those that the process did not make itself.
    pub fn add_of_standby(&mut self, pulse: &Pulse, fresh_ns: u64) {
        let sequence = pulse.header.sequence;
        let outputs = self.newest_output.map_or(1, |newest| sequence.saturating_sub(newest));
        self.newest_output = self.newest_output.max(Some(sequence));
        let timely = outputs.saturating_sub(u64::from(!is_timely(pulse)));
        self.account(pulse, timely, fresh_ns);
    }

    /// Accounts for the cycles up to that of `pulse`, `timely` of which had a timely output; returns how many had none.
    fn account(&mut self, pulse: &Pulse, timely: u64, fresh_ns: u64) -> u64 {
        let header = &pulse.header;
        let is_timely = is_timely(pulse);
        let is_good = is_timely && header.published_ns.saturating_sub(header.sensor_ns) <= fresh_ns;
        let good = if is_good { timely } else { 0 };
        self.outage_on_fresh_data.report(header.cycle, good, is_good);
        self.outage.report(header.cycle, timely, is_timely)
    }

    /// Timely outputs since the newest pulse, that of `now` included. A replacement counts its sequence on from its
    /// predecessor's checkpoint, or from 0 without one.
    fn timely_outputs(&self, now: PulseCounters) -> u64 {
        let (outputs, missed) = match (self.last, self.newest_output) {
            (Some(last), Some(newest)) if last.generation == now.generation => {
                (now.sequence.saturating_sub(newest), now.missed.saturating_sub(last.missed))
            }
            (Some(_), Some(newest)) if now.sequence > newest => (now.sequence - newest, now.missed),
            // Of a replacement that counts from further back, no more is known than this one output.
            (Some(_), _) => (1, now.missed),
            (None, _) => (now.sequence + 1, now.missed),
        };
        outputs.saturating_sub(missed)
    }

    /// Outputs since the newest pulse, without that of `now`. How many a dead predecessor has made last is not known.
    fn unseen_outputs(&self, now: PulseCounters) -> u64 {
        match self.last {
            Some(last) if last.generation == now.generation => now.sequence.saturating_sub(last.sequence + 1),
            None if now.generation == 0 => now.sequence,
            _ => 0,
        }
    }
}

fn is_timely(pulse: &Pulse) -> bool {
    pulse.header.published_ns <= pulse.released_ns + PERIOD_NS
}
