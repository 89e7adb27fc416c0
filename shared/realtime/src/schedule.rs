use coact_period::PERIOD_NS;

/// When each tick is released: the same in every process of a run, because all count from the run's start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// Release of tick 0, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
}

impl Schedule {
    /// Instant at which `tick` is released, ns of `CLOCK_MONOTONIC`.
    pub fn release(&self, tick: u64) -> u64 {
        self.start_ns + tick * PERIOD_NS
    }

    /// The tick whose period contains `ns`; tick 0 before the start.
    pub fn tick_at(&self, ns: u64) -> u64 {
        ns.saturating_sub(self.start_ns) / PERIOD_NS
    }

    /// The tick to begin after `tick`, when it is `ns` now.
    ///
    /// A cycle that overran is followed by the next one that is released, in all stages alike. Nothing is caught up
    /// with, so one late cycle does not make the next one late.
    pub(crate) fn following(&self, tick: u64, ns: u64) -> u64 {
        (tick + 1).max(self.next_after(ns))
    }

    /// The first tick that is not yet released at `ns`.
    pub fn next_after(&self, ns: u64) -> u64 {
        ns.saturating_sub(self.start_ns).div_ceil(PERIOD_NS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: u64 = 5 * PERIOD_NS;
    const SCHEDULE: Schedule = Schedule { start_ns: START };

    #[test]
    fn tick_lasts_from_its_release_to_the_next() {
        for tick in [0, 1, 999] {
            let release = SCHEDULE.release(tick);
            assert_eq!(SCHEDULE.tick_at(release), tick);
            assert_eq!(SCHEDULE.tick_at(release + PERIOD_NS - 1), tick);
            assert_eq!(SCHEDULE.next_after(release), tick);
            assert_eq!(SCHEDULE.next_after(release + 1), tick + 1);
        }
    }

    #[test]
    fn tick_that_overran_is_followed_by_the_next_release() {
        let follows = |ns: u64| SCHEDULE.following(3, START + ns);
        let release = |tick: u64| tick * PERIOD_NS;
        assert_eq!(
            [release(3) + 1, release(4) - 1, release(4)].map(follows),
            [4; 3],
            "it ended within its period"
        );
        assert_eq!([release(4) + 1, release(5)].map(follows), [5; 2], "its successor is released already");
        assert_eq!([release(35), release(35) + 1].map(follows), [35, 36], "much later");
    }

    #[test]
    fn before_the_start_comes_tick_zero() {
        assert_eq!((SCHEDULE.tick_at(10), SCHEDULE.next_after(10)), (0, 0));
    }
}
