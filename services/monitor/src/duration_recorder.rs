use coact_period::PERIOD_NS;
use coact_run_records::Percentiles;
use hdrhistogram::Histogram;
use std::time::Duration;

/// Expected interval between two values, ns: the period. What a histogram is corrected with for coordinated
/// omission: a value longer than it hides others, each one interval shorter, that were never taken.
pub const INTERVAL_NS: u64 = PERIOD_NS;
/// Largest value that a histogram tells apart, ns. Longer than any stall that the supervisor's watchdog lets a process
/// live through; a process that stays away for longer is a fault, not a latency.
const HIGHEST_NS: u64 = Duration::from_secs(60).as_nanos() as u64;
/// Significant digits of a histogram: durations are told apart by one part in a thousand, at 220 kB for each.
const DIGITS: u8 = 3;

/// A histogram of durations in ns, three significant digits, from 1 ns to 60 s.
pub fn histogram() -> Histogram<u64> {
    #[allow(clippy::expect_used, reason = "the bounds are constants, and valid")]
    Histogram::new_with_bounds(1, HIGHEST_NS, DIGITS).expect("bounds are valid")
}

/// A histogram in short; all 0 when it is empty.
pub fn percentiles(histogram: &Histogram<u64>) -> Percentiles {
    Percentiles {
        count: histogram.len(),
        p50: histogram.value_at_quantile(0.5),
        p99: histogram.value_at_quantile(0.99),
        p999: histogram.value_at_quantile(0.999),
        max: histogram.max(),
    }
}

/// Durations of one sort: since the start of the run, and since the last interval was written.
#[derive(Debug, Clone)]
pub struct DurationRecorder {
    total: Histogram<u64>,
    interval: Histogram<u64>,
}

impl Default for DurationRecorder {
    fn default() -> Self {
        Self { total: histogram(), interval: histogram() }
    }
}

impl DurationRecorder {
    /// Goes on from what was recorded before a restart.
    pub fn resume(total: Histogram<u64>) -> Self {
        Self { total, interval: histogram() }
    }

    /// Records a duration, ns; one longer than the range counts as the longest.
    pub fn record(&mut self, duration_ns: u64) {
        self.total.saturating_record(duration_ns);
        self.interval.saturating_record(duration_ns);
    }

    /// All durations of the run.
    pub fn total(&self) -> &Histogram<u64> {
        &self.total
    }

    /// All durations of the run, corrected for coordinated omission.
    pub fn corrected(&self) -> Histogram<u64> {
        self.total.clone_correct(INTERVAL_NS)
    }

    /// What was recorded since the last call.
    pub fn take_interval(&mut self) -> Histogram<u64> {
        std::mem::replace(&mut self.interval, histogram())
    }
}
