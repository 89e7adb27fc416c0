use rustix::time::{ClockId, clock_gettime};
use std::time::Duration;

/// Now, on `CLOCK_MONOTONIC`: the clock of all stamps in messages and reports.
pub fn now() -> Duration {
    let now = clock_gettime(ClockId::Monotonic);
    Duration::new(now.tv_sec.unsigned_abs(), now.tv_nsec as u32)
}

/// `time` in whole ns, as stamps are written.
pub fn stamp(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}
