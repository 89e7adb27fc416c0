use sd_notify::NotifyState;
use std::time::Duration;

/// Tells systemd, where it started the set, that the run has begun, that the supervisor lives, and that the set stops.
/// Elsewhere nobody is told anything.
#[derive(Debug)]
pub(crate) struct ServiceManager {
    /// How often systemd is told that the supervisor lives; `None` where it does not want to know.
    interval: Option<Duration>,
    due: Duration,
}

impl ServiceManager {
    /// What the environment says of who started this process.
    pub(crate) fn from_environment() -> Self {
        // Half the time after which systemd takes the silent for hung, as its manual advises.
        Self { interval: sd_notify::watchdog_enabled().map(|limit| limit / 2), due: Duration::ZERO }
    }

    /// The run's clock runs.
    pub(crate) fn run_begins(&self) {
        tell(NotifyState::Ready);
    }

    /// The supervisor lives; to be called in each turn of its loop.
    pub(crate) fn is_alive(&mut self, now: Duration) {
        if let Some(interval) = self.interval.filter(|_| now >= self.due) {
            self.due = now + interval;
            tell(NotifyState::Watchdog);
        }
    }

    /// The set is being stopped.
    pub(crate) fn run_ends(&self) {
        tell(NotifyState::Stopping);
    }
}

/// A service manager that cannot be reached is no reason to end a run.
fn tell(state: NotifyState<'_>) {
    if let Err(error) = sd_notify::notify(&[state]) {
        tracing::debug!("systemd was not told: {error}");
    }
}
