use crate::RunningChild;
use crate::kill_reason::KillReason;
use crate::running::Running;
use coact_realtime::HUNG_THREAD;
use rustix::process::Signal;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;
use std::time::Duration;

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
    /// Nobody else ended it: it crashed, hung or never got ready.
    pub(crate) by_itself: bool,
    /// How long it lived.
    pub(crate) lived: Duration,
    pub(crate) child: RunningChild,
}

impl Death {
    /// Without a `status`, it went to somebody else.
    pub(crate) fn new(running: Running, status: Option<ExitStatus>, now: Duration) -> Self {
        Self {
            pid: running.child.pid(),
            reason: running.kill_reason.map_or_else(|| describe(status), |reason| reason.to_string()),
            not_ready_in_time: matches!(running.kill_reason, Some(KillReason::NotReadyInTime(_))),
            was_ready: running.ready,
            exited: status.is_some_and(|status| status.code().is_some()),
            by_itself: by_itself(running.kill_reason, status),
            lived: now.saturating_sub(running.since),
            child: running.child,
        }
    }
}

/// Whether the reason lies in the process: no signal came from outside, or one because it was hung.
fn by_itself(killed: Option<KillReason>, status: Option<ExitStatus>) -> bool {
    let outside = [Signal::KILL, Signal::TERM, Signal::INT].map(|signal| Some(signal.as_raw()));
    match killed {
        Some(KillReason::Hung(_) | KillReason::NotReadyInTime(_)) => true,
        Some(_) => false,
        None => status.is_some_and(|status| !outside.contains(&status.signal())),
    }
}

/// How it ended, in words.
fn describe(status: Option<ExitStatus>) -> String {
    let Some(status) = status else {
        return "ended; how, was told to nobody: an earlier supervisor had started it".into();
    };
    match (status.signal(), status.code()) {
        (Some(signal), _) => match Signal::from_named_raw(signal) {
            Some(name) => format!("killed by {}", signal_name(name)),
            None => format!("killed by signal {signal}"),
        },
        (None, Some(HUNG_THREAD)) => "ended by itself, because a thread of it hung".into(),
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
        other => return format!("signal {}", other.as_raw()),
    };
    name.into()
}
