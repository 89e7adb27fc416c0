use crate::kill_reason::KillReason;
use crate::start_fault::StartFault;
use crate::{RunningChild, watchdog};
use rustix::process::Signal;
use std::time::{Duration, SystemTime};

/// Who computes for this fraction of the time has its core for itself. Chosen by hand: interrupts take the rest.
const BUSY: f64 = 0.8;
/// Who would compute, and does for less than this fraction of the time, has no core. Chosen by hand: what hangs in a loop on a core that
/// several share computes for longer.
const STARVED: f64 = 0.1;

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
    /// Since when it has been watched more closely because it is silent: by the watch clock, and the time that it had computed for.
    watched_closely: Option<(Duration, Duration)>,
    /// Since when it was found asleep at each look, because it is silent while its core goes on: by the watch clock, and the time that it
    /// had computed for.
    asleep_since: Option<(Duration, Duration)>,
    /// It has real-time scheduling, by its own report.
    pub(crate) is_realtime: bool,
    /// Its newest heartbeat, if it has any.
    pub(crate) heartbeat: Option<SystemTime>,
    /// The time that it had computed for by then.
    computed_by_heartbeat: Option<Duration>,
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
            watched_closely: None,
            asleep_since: None,
            is_realtime: false,
            heartbeat: None,
            computed_by_heartbeat: None,
            kill_reason: None,
            continue_at: None,
            at_start,
        }
    }

    /// It published a pulse: it is not hung.
    pub(crate) fn pulse(&mut self, watched: Duration) {
        self.last_sign = watched;
        self.has_pulsed = true;
        (self.watched_closely, self.asleep_since) = (None, None);
    }

    /// Its heartbeat is a new one.
    pub(crate) fn beats(&mut self, beat: SystemTime, watched: Duration) {
        self.heartbeat = Some(beat);
        self.computed_by_heartbeat = self.child.computed();
        self.last_sign = watched;
    }

    /// Whether others have had its core since its last heartbeat, `silence` ago.
    pub(crate) fn starves(&self, silence: Duration) -> bool {
        let computed = self.child.computed().zip(self.computed_by_heartbeat);
        let computed = computed.map(|(now, then)| now.saturating_sub(then));
        computed.is_some_and(|computed| computed < silence.mul_f64(STARVED)) && self.child.is_runnable()
    }

    /// How long it may be silent whose `limit` of silence is this, if it certainly hangs: it is stopped, or it computes without end.
    /// One that waits for its core or for another process does neither.
    pub(crate) fn certain_limit(
        &mut self,
        silence: Duration,
        limit: Duration,
        watched: Duration,
    ) -> Option<Duration> {
        let (stopped, computes) = (watchdog::stopped(limit), watchdog::computes(limit));
        if silence > stopped && self.child.is_stopped() {
            return Some(stopped);
        }
        (silence >= computes / 2 && self.computes_without_end(computes, watched)).then_some(computes)
    }

    /// Looked at from half its limit on, `computes`.
    fn computes_without_end(&mut self, computes: Duration, watched: Duration) -> bool {
        let Some(computed) = self.child.computed() else { return false };
        let (since, before) = *self.watched_closely.get_or_insert((watched, computed));
        let (span, busy) = (watched.saturating_sub(since), computed.saturating_sub(before));
        self.has_pulsed && span >= computes / 2 && busy >= span.mul_f64(BUSY)
    }

    /// Whether it has slept for some milliseconds, without running at all, while its `core_goes_on`: for what never comes. One that goes on
    /// as well is woken in each period, by its input or by its timer.
    pub(crate) fn sleeps_without_end(
        &mut self,
        core_goes_on: bool,
        silence: Duration,
        limit: Duration,
        watched: Duration,
    ) -> bool {
        let suspected = watchdog::suspected(limit);
        let is_watched = core_goes_on && silence >= suspected && self.child.is_asleep();
        let computed = self.child.computed().filter(|_| is_watched);
        let same = self.asleep_since.filter(|(_, before)| computed == Some(*before));
        self.asleep_since = same.or(computed.map(|computed| (watched, computed)));
        let slept = self.asleep_since.map_or(Duration::ZERO, |(since, _)| watched.saturating_sub(since));
        self.has_pulsed && slept >= watchdog::sleeps(limit) - suspected
    }

    /// Whether it may sleep for what never comes: the next looks tell.
    pub(crate) fn is_suspected(&self) -> bool {
        self.asleep_since.is_some()
    }

    /// Kills it, once, for this reason.
    pub(crate) fn kill(&mut self, reason: KillReason) {
        if self.kill_reason.is_none() {
            self.kill_reason = Some(reason);
            self.child.demote();
            self.child.signal(Signal::KILL);
        }
    }
}
