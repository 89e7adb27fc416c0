use coact_pipeline::RestartPolicy;
use std::collections::VecDeque;
use std::time::Duration;

/// Deaths of one process within the sliding window of a [`RestartPolicy`].
#[derive(Debug, Clone, Default)]
pub struct RestartHistory {
    /// Times of death, oldest first.
    deaths: VecDeque<Duration>,
}

impl RestartHistory {
    /// Enters a death at `now` (any monotonic zero). Returns how long to wait before the replacement is started; `None`
    /// when the process is to be given up.
    pub fn died(&mut self, policy: &RestartPolicy, now: Duration) -> Option<Duration> {
        self.deaths.retain(|&at| now.saturating_sub(at) <= policy.window);
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
        window: Duration::from_secs(10),
        backoff_initial: Duration::from_millis(50),
        backoff_max: Duration::from_millis(200),
        hung_after: SECOND,
    };

    #[test]
    fn restarts_older_than_the_window_do_not_count() {
        let mut history = RestartHistory::default();
        for i in 0..100 {
            assert_eq!(history.died(&POLICY, i * 11 * SECOND), Some(Duration::ZERO));
        }
        assert_eq!(
            history.died(&POLICY, 1090 * SECOND),
            Some(POLICY.backoff_initial),
            "the last one is 1 s ago"
        );
        assert_eq!(history.died(&POLICY, 1091 * SECOND), None);
    }

    #[test]
    fn deaths_at_the_same_instant_count_each() {
        let mut history = RestartHistory::default();
        let pauses: Vec<_> = (0..3).map(|_| history.died(&POLICY, SECOND)).collect();
        assert_eq!(pauses, [Some(Duration::ZERO), Some(POLICY.backoff_initial), None]);
    }
}
