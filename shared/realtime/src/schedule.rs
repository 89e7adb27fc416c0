use coact_period::PERIOD_NS;

/// When each tick is released: the same in every process of a run, because all count from the run's start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// Release of tick 0, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
}

/// A release that is no longer ago still begins a cycle, ns. Chosen by hand: half a period, in the rest of which the whole chain is done.
const STILL_BEGINS: u64 = PERIOD_NS / 2;

impl Schedule {
    /// Instant at which `tick` is released, ns of `CLOCK_MONOTONIC`.
    pub fn release(&self, tick: u64) -> u64 {
        self.start_ns + tick * PERIOD_NS
    }

    /// The tick whose period contains `ns`; tick 0 before the start.
    pub fn tick_at(&self, ns: u64) -> u64 {
        ns.saturating_sub(self.start_ns) / PERIOD_NS
    }

    /// The tick to begin after `tick`, when it is `ns` now; `in_time` tells that `tick` was begun at its release.
    ///
    /// One that overran a little is followed by the one that has just been released: a late cycle costs no second one. One that
    /// overran by more, or was late itself, is followed by the next release, in all stages alike: nothing is caught up with, and a
    /// core that several share is left to the others.
    pub(crate) fn following(&self, tick: u64, ns: u64, in_time: bool) -> u64 {
        let ago = if in_time { STILL_BEGINS } else { 0 };
        (tick + 1).max(self.next_after(ns.saturating_sub(ago)))
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
    fn tick_that_overran_is_followed_by_the_one_that_there_is_time_for() {
        let follows = |ns: u64| [true, false].map(|in_time| SCHEDULE.following(3, START + ns, in_time));
        let release = |tick: u64| tick * PERIOD_NS;
        for within in [release(3) + 1, release(4) - 1, release(4)] {
            assert_eq!(follows(within), [4; 2], "it ended within its period");
        }
        for just in [release(4) + 1, release(4) + STILL_BEGINS] {
            assert_eq!(
                follows(just),
                [4, 5],
                "its successor has just begun: begun at once, but not twice in a row"
            );
        }
        for late in [release(4) + STILL_BEGINS + 1, release(5)] {
            assert_eq!(follows(late), [5; 2], "there is no time left for it");
        }
        assert_eq!(
            [release(35), release(35) + STILL_BEGINS + 1].map(follows),
            [[35; 2], [36; 2]],
            "much later"
        );
    }

    #[test]
    fn before_the_start_comes_tick_zero() {
        assert_eq!((SCHEDULE.tick_at(10), SCHEDULE.next_after(10)), (0, 0));
    }
}
