/// Times after which control stops waiting, in cycles of 1 ms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// A sensor sample or field frame older than this makes the robot brake and stand.
    pub stale_after: u64,
    /// How long a part that no decision concerns stays in the hand before it is put back.
    pub put_back_after: u64,
    /// How long after a failure the same decision is tried again.
    pub retry_after: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { stale_after: 50, put_back_after: 5_000, retry_after: 2_000 }
    }
}
