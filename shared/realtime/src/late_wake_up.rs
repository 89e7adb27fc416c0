/// A wake-up of a [`LatencyProbe`](crate::LatencyProbe) that came half a period late, or later: the machine did nothing for real-time
/// threads between the two instants, ns of `CLOCK_MONOTONIC`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LateWakeUp {
    /// When it was due.
    pub due_ns: u64,
    /// When it came.
    pub woken_ns: u64,
}
