/// What a [`LatencyProbe`](crate::LatencyProbe) has measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WakeUpLateness {
    /// How often it woke up.
    pub wakeups: u64,
    /// How often it did so a whole period late, or later.
    pub late: u64,
    /// The greatest lateness, ns.
    pub longest_ns: u64,
}
