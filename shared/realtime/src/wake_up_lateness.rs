/// What a [`LatencyProbe`](crate::LatencyProbe) has measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WakeUpLateness {
    /// How often it woke up.
    pub wakeups: u64,
    /// How often it did so a whole period late, or later.
    pub late: u64,
    /// 99.9 % of its wake-ups were no later than this, ns, to the microsecond.
    pub p999_ns: u64,
    /// The greatest lateness, ns.
    pub longest_ns: u64,
}
