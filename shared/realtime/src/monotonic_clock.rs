//! `CLOCK_MONOTONIC`: the clock of all stamps in messages, schedules and reports.

use rustix::time::{ClockId, Timespec, clock_gettime};
use std::time::Duration;

/// Now, as a stamp: ns of `CLOCK_MONOTONIC`.
pub fn now() -> u64 {
    monotonic_time().as_nanos() as u64
}

/// Now, as a duration since the clock's own zero.
pub fn monotonic_time() -> Duration {
    let Timespec { tv_sec, tv_nsec } = clock_gettime(ClockId::Monotonic);
    Duration::new(tv_sec as u64, tv_nsec as u32)
}

/// What this thread has computed so far, ns of a core's time.
pub fn thread_time() -> u64 {
    let Timespec { tv_sec, tv_nsec } = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(tv_sec as u64, tv_nsec as u32).as_nanos() as u64
}

/// An instant or a span in ns, as the kernel takes it.
pub(crate) fn timespec(ns: u64) -> Timespec {
    let span = Duration::from_nanos(ns);
    Timespec { tv_sec: span.as_secs() as i64, tv_nsec: i64::from(span.subsec_nanos()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clock_never_runs_backwards() {
        let first = now();
        assert!(now() >= first && monotonic_time() >= Duration::from_nanos(first));
    }

    #[test]
    fn a_span_is_split_into_seconds_and_nanoseconds() {
        let span = timespec(3_000_000_007);
        assert_eq!((span.tv_sec, span.tv_nsec), (3, 7));
    }
}
