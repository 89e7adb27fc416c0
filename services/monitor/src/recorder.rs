use hdrhistogram::Histogram;

/// Expected interval between two values, ns: the period. What a histogram is corrected with for coordinated
/// omission: a value longer than it hides others, each one interval shorter, that were never taken.
pub const INTERVAL_NS: u64 = 1_000_000;
/// Largest value that a histogram tells apart, ns.
const HIGHEST_NS: u64 = 60_000_000_000;

/// A histogram of durations in ns, three significant digits, from 1 ns to 60 s.
pub fn histogram() -> Histogram<u64> {
    #[allow(clippy::expect_used, reason = "the bounds are constants, and valid")]
    Histogram::new_with_bounds(1, HIGHEST_NS, 3).expect("bounds are valid")
}

/// Durations of one sort: since the start of the run, and since the last interval was written.
#[derive(Debug, Clone)]
pub struct Recorder {
    total: Histogram<u64>,
    interval: Histogram<u64>,
}

impl Default for Recorder {
    fn default() -> Self {
        Self { total: histogram(), interval: histogram() }
    }
}

impl Recorder {
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
