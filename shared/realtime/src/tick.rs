/// One period of one process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// Its number, counted from the start of the run.
    pub cycle: u64,
    /// Its release, ns of `CLOCK_MONOTONIC`.
    pub released_ns: u64,
    /// When this process started on it, ns of `CLOCK_MONOTONIC`.
    pub started_ns: u64,
}
