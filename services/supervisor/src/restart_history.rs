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
        policy.pause(self.enter(policy, now))
    }

    /// As [`RestartHistory::died`], of a process that is never given up.
    pub fn died_and_returns(&mut self, policy: &RestartPolicy, now: Duration) -> Duration {
        policy.growing_pause(self.enter(policy, now))
    }

    /// Whether any death was entered that is not forgotten.
    pub fn has_deaths(&self) -> bool {
        !self.deaths.is_empty()
    }

    /// Returns how many deaths were within the window before this one.
    fn enter(&mut self, policy: &RestartPolicy, now: Duration) -> u32 {
        self.deaths.retain(|&at| now.saturating_sub(at) <= policy.window);
        let recent = u32::try_from(self.deaths.len()).unwrap_or(u32::MAX);
        self.deaths.push_back(now);
        recent
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
    fn what_is_never_given_up_returns_after_pauses_that_grow_up_to_the_longest() {
        let mut history = RestartHistory::default();
        let pauses: Vec<_> = (0..6).map(|_| history.died_and_returns(&POLICY, SECOND).as_millis()).collect();
        assert_eq!(pauses, [0, 50, 100, 200, 200, 200]);
        assert_eq!(history.died_and_returns(&POLICY, 20 * SECOND), Duration::ZERO, "all are forgotten");
    }

    #[test]
    fn deaths_at_the_same_instant_count_each() {
        let mut history = RestartHistory::default();
        let pauses: Vec<_> = (0..3).map(|_| history.died(&POLICY, SECOND)).collect();
        assert_eq!(pauses, [Some(Duration::ZERO), Some(POLICY.backoff_initial), None]);
    }
}
