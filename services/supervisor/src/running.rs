use crate::RunningChild;
use crate::kill_reason::KillReason;
use crate::start_fault::StartFault;
use rustix::process::Signal;
use std::time::{Duration, SystemTime};

/// What is known of a running process. Times are of `CLOCK_MONOTONIC`.
#[derive(Debug)]
pub(crate) struct Running {
    pub(crate) child: RunningChild,
    pub(crate) since: Duration,
    pub(crate) ready: bool,
    /// Its newest sign of life, by the watch clock: a pulse, a heartbeat, or its readiness.
    pub(crate) last_sign: Duration,
    /// It has sent a pulse.
    pub(crate) has_pulsed: bool,
    /// It has real-time scheduling, by its own report.
    pub(crate) is_realtime: bool,
    /// Its newest heartbeat, if it has any.
    pub(crate) heartbeat: Option<SystemTime>,
    /// Why the watchdog killed it, if it did.
    pub(crate) kill_reason: Option<KillReason>,
    /// When a process that was stopped by a fault is continued.
    pub(crate) continue_at: Option<Duration>,
    /// What is done to a starting process before it is ready, and when.
    pub(crate) at_start: Option<(Duration, StartFault)>,
}

impl Running {
    /// A child that was started just now.
    pub(crate) fn new(child: RunningChild, now: Duration, at_start: Option<(Duration, StartFault)>) -> Self {
        Self {
            child,
            since: now,
            ready: false,
            last_sign: Duration::ZERO,
            has_pulsed: false,
            is_realtime: false,
            heartbeat: None,
            kill_reason: None,
            continue_at: None,
            at_start,
        }
    }

    /// Kills it, once, for this reason.
    pub(crate) fn kill(&mut self, reason: KillReason) {
        if self.kill_reason.is_none() {
            self.kill_reason = Some(reason);
            self.child.signal(Signal::KILL);
        }
    }
}
