use std::time::Duration;

/// The time that the watchdog has watched: it goes on only as far as the supervisor itself ran on time. Where the whole
/// machine stalled, nobody was silent, and nobody is killed for it.
#[derive(Debug, Default)]
pub(crate) struct WatchClock {
    looked_at: Option<Duration>,
    watched: Duration,
}

impl WatchClock {
    /// The most that one look adds: four times the interval at which a running supervisor looks (1 ms).
    const LONGEST_STEP: Duration = Duration::from_millis(4);

    /// The supervisor looks at `now`, of a monotonic clock.
    pub(crate) fn look(&mut self, now: Duration) {
        let since = self.looked_at.map_or(Duration::ZERO, |before| now.saturating_sub(before));
        self.watched += since.min(Self::LONGEST_STEP);
        self.looked_at = Some(now);
    }

    /// The time watched so far.
    pub(crate) fn watched(&self) -> Duration {
        self.watched
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_on_with_the_looks_and_stands_still_while_the_machine_does() {
        let ms = Duration::from_millis;
        let mut clock = WatchClock::default();
        for at in [100, 102, 104, 1104, 1106] {
            clock.look(ms(at));
        }
        assert_eq!(clock.watched(), ms(2 + 2 + 4 + 2));
    }
}
