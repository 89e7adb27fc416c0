use crate::{Fault, ProcessSpec, RestartHistory, RunningChild};
use rustix::process::Signal;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;
use std::time::Duration;

/// One process of the set, in all its generations.
#[derive(Debug)]
pub(crate) struct Supervised {
    pub(crate) spec: ProcessSpec,
    pub(crate) generation: u32,
    pub(crate) lifecycle: Lifecycle,
    pub(crate) history: RestartHistory,
    /// Fault that was injected and not yet recovered from; the events that it causes name it.
    pub(crate) fault: Option<Fault>,
    /// The next replacement is to be killed before it is ready.
    pub(crate) crash_next: bool,
}

/// What state a process is in.
#[derive(Debug)]
pub(crate) enum Lifecycle {
    /// Not started yet: processes of a lower order are not ready.
    Waiting,
    /// Running, ready or not.
    Running(Running),
    /// Dead; its replacement is to be started at this time.
    RestartDue(Duration),
    /// Ended, and not to be started again.
    Stopped,
}

/// What is known of a running process. Times are of `CLOCK_MONOTONIC`.
#[derive(Debug)]
pub(crate) struct Running {
    pub(crate) child: RunningChild,
    pub(crate) since: Duration,
    pub(crate) ready: bool,
    /// Its newest sign of life: a pulse, or its start.
    pub(crate) last_sign: Duration,
    /// Killed because it was not ready in time.
    pub(crate) not_ready_in_time: bool,
    /// Why the watchdog killed it, if it did.
    pub(crate) kill_reason: Option<String>,
    /// When a stopped process is continued.
    pub(crate) continue_at: Option<Duration>,
    /// When a starting process is killed, as the fault `crash-on-start` demands.
    pub(crate) crash_at: Option<Duration>,
}

/// How a process ended.
#[derive(Debug)]
pub(crate) struct Death {
    pub(crate) pid: u32,
    pub(crate) reason: String,
    /// It was not ready in time.
    pub(crate) not_ready_in_time: bool,
    pub(crate) was_ready: bool,
    /// It ended by itself, not by a signal.
    pub(crate) exited: bool,
    pub(crate) child: RunningChild,
}

impl Supervised {
    /// How long after its start a replacement is killed by `crash-on-start`: while it opens its ports. Chosen by hand.
    const CRASH_AFTER: Duration = Duration::from_millis(5);

    pub(crate) fn new(spec: ProcessSpec) -> Self {
        let history = RestartHistory::default();
        Self { spec, generation: 0, lifecycle: Lifecycle::Waiting, history, fault: None, crash_next: false }
    }

    pub(crate) fn running(&self) -> Option<&Running> {
        match &self.lifecycle {
            Lifecycle::Running(running) => Some(running),
            _ => None,
        }
    }

    pub(crate) fn running_mut(&mut self) -> Option<&mut Running> {
        match &mut self.lifecycle {
            Lifecycle::Running(running) => Some(running),
            _ => None,
        }
    }

    pub(crate) fn is_ready(&self) -> bool {
        self.running().is_some_and(|running| running.ready)
    }

    /// Enters a child that was just started.
    pub(crate) fn started(&mut self, child: RunningChild, now: Duration) {
        let crash_at = std::mem::take(&mut self.crash_next).then_some(now + Self::CRASH_AFTER);
        self.lifecycle = Lifecycle::Running(Running {
            child,
            since: now,
            ready: false,
            last_sign: now,
            not_ready_in_time: false,
            kill_reason: None,
            continue_at: None,
            crash_at,
        });
    }

    /// Its death, if it died; it is down from then on.
    pub(crate) fn died(&mut self, now: Duration) -> Option<Death> {
        let status = self.running_mut()?.child.exit_status()?;
        let Lifecycle::Running(running) = std::mem::replace(&mut self.lifecycle, Lifecycle::RestartDue(now))
        else {
            return None;
        };
        Some(Death {
            pid: running.child.pid(),
            reason: running.kill_reason.unwrap_or_else(|| describe(status)),
            not_ready_in_time: running.not_ready_in_time,
            was_ready: running.ready,
            exited: status.code().is_some(),
            child: running.child,
        })
    }

    /// True once, when its ready file has appeared.
    pub(crate) fn becomes_ready(&mut self, now: Duration) -> bool {
        if self.running().is_none_or(|running| running.ready) {
            return false;
        }
        let has_reported = self.spec.ready_file(self.generation).exists();
        let Some(running) = self.running_mut() else { return false };
        if running.crash_at.is_some() || running.kill_reason.is_some() || !has_reported {
            return false;
        }
        running.ready = true;
        running.last_sign = now;
        true
    }

    /// Kills it when it is not ready in time, hung, or due to crash by an injected fault; continues it when its injected
    /// pause is over. Pulses are expected from `pulses_from` on.
    pub(crate) fn watchdog(&mut self, now: Duration, pulses_from: Option<Duration>) {
        let (ready_within, hung_after) = (self.spec.ready_within, self.spec.hung_after);
        let Lifecycle::Running(running) = &mut self.lifecycle else { return };
        if running.continue_at.is_some_and(|due| now >= due) {
            running.continue_at = None;
            running.child.signal(Signal::CONT);
            self.fault = None;
        }
        if running.crash_at.is_some_and(|due| now >= due) {
            running.crash_at = None;
            running.kill("killed before it was ready: injected crash-on-start".into());
        }
        if !running.ready && now.saturating_sub(running.since) > ready_within {
            running.not_ready_in_time = true;
            running.kill(format!("not ready within {} s", ready_within.as_secs_f64()));
        }
        if let (Some(limit), Some(from)) = (hung_after, pulses_from)
            && running.ready
            && now.saturating_sub(running.last_sign.max(from)) > limit
        {
            running.kill(format!("hung: no pulse for more than {} ms", limit.as_millis()));
        }
    }
}

impl Supervised {
    /// Requests that it ends; SIGCONT, because a stopped process would not see the request.
    pub(crate) fn request_stop(&mut self) {
        if let Some(running) = self.running() {
            running.child.signal(Signal::TERM);
            running.child.signal(Signal::CONT);
        }
    }

    /// Kills it when it did not end within its grace, `elapsed` after the request.
    pub(crate) fn kill_after_grace(&mut self, elapsed: Duration) {
        let grace = self.spec.stop_grace;
        if let Some(running) = self.running_mut().filter(|_| elapsed > grace) {
            running.kill(format!("killed: it did not end within {} s", grace.as_secs_f64()));
        }
    }
}

impl Running {
    /// Kills it, once, for this reason.
    fn kill(&mut self, reason: String) {
        if self.kill_reason.is_none() {
            self.kill_reason = Some(reason);
            self.child.signal(Signal::KILL);
        }
    }
}

/// How it ended, in words.
fn describe(status: ExitStatus) -> String {
    match (status.signal(), status.code()) {
        (Some(signal), _) => match Signal::from_named_raw(signal) {
            Some(name) => format!("killed by {}", signal_name(name)),
            None => format!("killed by signal {signal}"),
        },
        (None, Some(code)) => format!("ended by itself with exit status {code}"),
        (None, None) => "ended by itself".into(),
    }
}

/// The usual names of the signals by which processes end.
fn signal_name(signal: Signal) -> String {
    let name = match signal {
        Signal::KILL => "SIGKILL",
        Signal::TERM => "SIGTERM",
        Signal::INT => "SIGINT",
        Signal::SEGV => "SIGSEGV (invalid memory access)",
        Signal::BUS => "SIGBUS (shared memory is full, or was removed)",
        Signal::ABORT => "SIGABRT",
        Signal::USR1 => "SIGUSR1",
        other => return format!("signal {}", other.as_raw()),
    };
    name.into()
}
