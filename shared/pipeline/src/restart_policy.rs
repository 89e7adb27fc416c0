use std::time::Duration;

/// What happens when a process dies, in the terms of OTP supervisors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RestartPolicy {
    /// How many restarts of one process are made within [`RestartPolicy::window`]; one more and the run is given up.
    pub intensity: u32,
    /// Length of that sliding window.
    pub window: Duration,
    /// Pause before the second restart within the window; the first one is immediate. Doubled with each further one.
    pub backoff_initial: Duration,
    /// Longest pause before a restart.
    pub backoff_max: Duration,
    /// Silence (no pulse) after which the watchdog takes a process that takes part in every cycle for hung, and kills it.
    pub hung_after: Duration,
}

impl RestartPolicy {
    /// Pause before the next restart, after `recent` restarts within the window; `None` when it is to be given up.
    pub fn pause(&self, recent: u32) -> Option<Duration> {
        (recent < self.intensity).then(|| self.growing_pause(recent))
    }

    /// Pause before the next restart, after `recent` restarts within the window, of a process that is never given up.
    pub fn growing_pause(&self, recent: u32) -> Duration {
        match recent {
            0 => Duration::ZERO,
            // Beyond 20 doublings of 1 ms every backoff is longer than any that makes sense; the shift must not overflow.
            n => self.backoff_initial.saturating_mul(1 << (n - 1).min(20)).min(self.backoff_max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POLICY: RestartPolicy = RestartPolicy {
        intensity: 5,
        window: Duration::from_secs(30),
        backoff_initial: Duration::from_millis(100),
        backoff_max: Duration::from_millis(300),
        hung_after: Duration::from_millis(500),
    };

    #[test]
    fn first_restart_is_immediate_and_later_ones_back_off_up_to_the_maximum() {
        let pauses: Vec<_> = (0..5).map(|n| POLICY.pause(n).map(|pause| pause.as_millis())).collect();
        assert_eq!(pauses, [Some(0), Some(100), Some(200), Some(300), Some(300)]);
    }

    #[test]
    fn restarts_beyond_the_intensity_are_given_up() {
        assert_eq!(POLICY.pause(5), None);
        assert_eq!(RestartPolicy { intensity: 0, ..POLICY }.pause(0), None);
    }
}
