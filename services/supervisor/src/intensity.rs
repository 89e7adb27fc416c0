use std::collections::VecDeque;
use std::time::Duration;

/// How many restarts a set may need before it is given up: OTP's intensity and period, with a backoff.
///
/// As in OTP all processes of the set count together: more than `restarts` within `period` means that restarting
/// does not help. The backoff is each process's own: its first restart within a period is immediate, the second
/// waits `backoff`, each further one twice as long, `longest_backoff` at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Intensity {
    /// Restarts allowed within [`Intensity::period`].
    pub restarts: usize,
    /// The sliding window in which restarts count.
    pub period: Duration,
    /// Delay of a process's second restart within a period.
    pub backoff: Duration,
    /// Longest delay.
    pub longest_backoff: Duration,
}

/// What to do about a death.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Remedy {
    /// Start a replacement after this delay.
    RestartAfter(Duration),
    /// The intensity is exhausted: this death would need restart number `needed` within the period.
    GiveUp {
        /// Restarts that the period would have held.
        needed: usize,
    },
}

/// Restarts of the present period, and what they allow.
#[derive(Debug, Clone)]
pub struct RestartLedger {
    intensity: Intensity,
    /// Time of death and process of each restart within the period, oldest first.
    restarts: VecDeque<(Duration, usize)>,
}

impl RestartLedger {
    /// An empty ledger.
    pub fn new(intensity: Intensity) -> Self {
        Self { intensity, restarts: VecDeque::new() }
    }

    /// The limits that it was made with.
    pub fn intensity(&self) -> Intensity {
        self.intensity
    }

    /// Process number `process` died at time `now` (any monotonic zero): enters it and says what to do.
    pub fn died(&mut self, process: usize, now: Duration) -> Remedy {
        let Intensity { restarts, period, .. } = self.intensity;
        self.restarts.retain(|&(at, _)| now.saturating_sub(at) <= period);
        let earlier = self.restarts.iter().filter(|&&(_, other)| other == process).count();
        self.restarts.push_back((now, process));
        if self.restarts.len() > restarts {
            return Remedy::GiveUp { needed: self.restarts.len() };
        }
        Remedy::RestartAfter(self.backoff(earlier))
    }

    /// Delay after `earlier` restarts of the same process within the period.
    fn backoff(&self, earlier: usize) -> Duration {
        let Intensity { backoff, longest_backoff, .. } = self.intensity;
        let Some(doublings) = earlier.checked_sub(1) else { return Duration::ZERO };
        let factor = 1u32.checked_shl(doublings.min(31) as u32).unwrap_or(u32::MAX);
        backoff.saturating_mul(factor).min(longest_backoff)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    fn ledger(restarts: usize) -> RestartLedger {
        let backoff = Duration::from_millis(50);
        RestartLedger::new(Intensity { restarts, period: 10 * SECOND, backoff, longest_backoff: 4 * backoff })
    }

    fn after(milliseconds: u64) -> Remedy {
        Remedy::RestartAfter(Duration::from_millis(milliseconds))
    }

    #[test]
    fn the_first_restart_is_immediate_and_the_delay_doubles_up_to_its_limit() {
        let mut ledger = ledger(9);
        let remedies: Vec<_> = (0..6).map(|i| ledger.died(0, i * SECOND)).collect();
        assert_eq!(remedies, [after(0), after(50), after(100), after(200), after(200), after(200)]);
    }

    #[test]
    fn another_process_has_its_own_backoff_but_shares_the_intensity() {
        let mut ledger = ledger(3);
        assert_eq!(ledger.died(0, SECOND), after(0));
        assert_eq!(ledger.died(1, SECOND), after(0));
        assert_eq!(ledger.died(0, SECOND), after(50));
        assert_eq!(ledger.died(2, SECOND), Remedy::GiveUp { needed: 4 });
    }

    #[test]
    fn restarts_older_than_the_period_do_not_count() {
        let mut ledger = ledger(2);
        for i in 0..100 {
            assert_eq!(ledger.died(0, i * 11 * SECOND), after(0));
        }
        assert_eq!(ledger.died(0, 1090 * SECOND), after(50), "the last one is 1 s ago");
        assert_eq!(ledger.died(0, 1091 * SECOND), Remedy::GiveUp { needed: 3 });
    }

    #[test]
    fn without_intensity_the_first_death_is_the_last() {
        assert_eq!(ledger(0).died(0, SECOND), Remedy::GiveUp { needed: 1 });
    }

    #[test]
    fn very_many_restarts_keep_the_longest_delay() {
        let mut ledger = ledger(1000);
        let last = (0..200).map(|_| ledger.died(0, SECOND)).last();
        assert_eq!(last, Some(after(200)));
    }
}
