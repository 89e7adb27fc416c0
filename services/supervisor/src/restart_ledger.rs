use coact_pipeline::RestartPolicy;
use std::collections::VecDeque;
use std::time::Duration;

/// Restarts of one process within the sliding window of a [`RestartPolicy`].
#[derive(Debug, Clone, Default)]
pub struct RestartLedger {
    /// Times of death, oldest first.
    deaths: VecDeque<Duration>,
}

impl RestartLedger {
    /// The process died at `now` (any monotonic zero): how long to wait before its replacement is started; `None`
    /// when it is to be given up.
    pub fn died(&mut self, policy: &RestartPolicy, now: Duration) -> Option<Duration> {
        self.deaths.retain(|&at| now.saturating_sub(at) <= policy.period);
        let recent = u32::try_from(self.deaths.len()).unwrap_or(u32::MAX);
        self.deaths.push_back(now);
        policy.pause(recent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);
    const POLICY: RestartPolicy = RestartPolicy {
        intensity: 2,
        period: Duration::from_secs(10),
        backoff_initial: Duration::from_millis(50),
        backoff_max: Duration::from_millis(200),
        hung_after: SECOND,
    };

    #[test]
    fn restarts_older_than_the_period_do_not_count() {
        let mut ledger = RestartLedger::default();
        for i in 0..100 {
            assert_eq!(ledger.died(&POLICY, i * 11 * SECOND), Some(Duration::ZERO));
        }
        assert_eq!(
            ledger.died(&POLICY, 1090 * SECOND),
            Some(POLICY.backoff_initial),
            "the last one is 1 s ago"
        );
        assert_eq!(ledger.died(&POLICY, 1091 * SECOND), None);
    }

    #[test]
    fn deaths_at_the_same_instant_count_each() {
        let mut ledger = RestartLedger::default();
        let remedies: Vec<_> = (0..3).map(|_| ledger.died(&POLICY, SECOND)).collect();
        assert_eq!(remedies, [Some(Duration::ZERO), Some(POLICY.backoff_initial), None]);
    }
}
