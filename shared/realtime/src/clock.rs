use rustix::time::{ClockId, Timespec, clock_gettime};

/// `CLOCK_MONOTONIC`, ns.
pub fn now() -> u64 {
    let Timespec { tv_sec, tv_nsec } = clock_gettime(ClockId::Monotonic);
    tv_sec as u64 * 1_000_000_000 + tv_nsec as u64
}

/// An instant or a span in ns as the kernel takes it.
pub(crate) fn timespec(ns: u64) -> Timespec {
    Timespec { tv_sec: (ns / 1_000_000_000) as i64, tv_nsec: (ns % 1_000_000_000) as i64 }
}

/// Which tick is released when: the same in every process of a run, because all count from the run's start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// Release of tick 0, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
    /// Length of a period, ns.
    pub period_ns: u64,
}

impl Schedule {
    /// Instant at which `tick` is released, ns.
    pub fn release(&self, tick: u64) -> u64 {
        self.start_ns + tick * self.period_ns
    }

    /// The tick whose period contains `ns`; tick 0 before the start.
    pub fn tick_at(&self, ns: u64) -> u64 {
        ns.saturating_sub(self.start_ns) / self.period_ns
    }

    /// The tick to begin after `tick` at `ns`. One that overran is followed by the next that is released, so that all stages
    /// resume with the same one: there is no catching up, and no second late one because of the first.
    pub(crate) fn following(&self, tick: u64, ns: u64) -> u64 {
        (tick + 1).max(self.next_after(ns))
    }

    /// The first tick that is not yet released at `ns`.
    pub fn next_after(&self, ns: u64) -> u64 {
        ns.saturating_sub(self.start_ns).div_ceil(self.period_ns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCHEDULE: Schedule = Schedule { start_ns: 5_000, period_ns: 1_000 };

    #[test]
    fn tick_lasts_from_its_release_to_the_next() {
        for tick in [0, 1, 999] {
            let release = SCHEDULE.release(tick);
            assert_eq!(SCHEDULE.tick_at(release), tick);
            assert_eq!(SCHEDULE.tick_at(release + 999), tick);
            assert_eq!(SCHEDULE.next_after(release), tick);
            assert_eq!(SCHEDULE.next_after(release + 1), tick + 1);
        }
    }

    #[test]
    fn tick_that_overran_is_followed_by_the_next_release() {
        let follows = |ns: u64| SCHEDULE.following(3, ns);
        assert_eq!([8_001, 8_999, 9_000].map(follows), [4; 3], "it ended within its period");
        assert_eq!([9_001, 10_000].map(follows), [5; 2], "its successor is released already");
        assert_eq!([40_000, 40_001].map(follows), [35, 36], "much later");
    }

    #[test]
    fn before_the_start_comes_tick_zero() {
        assert_eq!((SCHEDULE.tick_at(10), SCHEDULE.next_after(10)), (0, 0));
    }

    #[test]
    fn clock_never_runs_backwards() {
        let first = now();
        assert!(now() >= first);
    }
}
