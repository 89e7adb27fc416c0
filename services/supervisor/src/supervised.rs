use crate::{Fault, ProcessSpec, RestartLedger, RunningChild};
use rustix::process::Signal;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;
use std::time::Duration;

/// One process of the set, over all its generations.
#[derive(Debug)]
pub(crate) struct Supervised {
    pub(crate) spec: ProcessSpec,
    pub(crate) generation: u32,
    pub(crate) phase: Phase,
    pub(crate) ledger: RestartLedger,
    /// Fault that was injected and not yet recovered from: stands in the events that it causes.
    pub(crate) fault: Option<Fault>,
    /// The next replacement is to be killed before it is ready.
    pub(crate) crash_next: bool,
}

/// Where a process stands.
#[derive(Debug)]
pub(crate) enum Phase {
    /// Not started yet: those before it are not ready.
    Waiting,
    /// Running, ready or not.
    Alive(Alive),
    /// Dead; its replacement is due at this time.
    Down(Duration),
    /// Ended for good.
    Stopped,
}

/// What is known of a running process. Times are of `CLOCK_MONOTONIC`.
#[derive(Debug)]
pub(crate) struct Alive {
    pub(crate) child: RunningChild,
    pub(crate) since: Duration,
    pub(crate) ready: bool,
    /// Its newest sign of life.
    pub(crate) heard: Duration,
    /// Killed because it was not ready in time.
    pub(crate) overdue: bool,
    /// Why the supervisor killed it, if it did.
    pub(crate) sentence: Option<String>,
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
    /// It never became ready in time.
    pub(crate) overdue: bool,
    pub(crate) was_ready: bool,
    /// It ended by itself, not by a signal.
    pub(crate) voluntary: bool,
    pub(crate) child: RunningChild,
}

impl Supervised {
    /// How long after its start a replacement is killed by `crash-on-start`: amid the making of its ports.
    const CRASH_AFTER: Duration = Duration::from_millis(5);

    pub(crate) fn new(spec: ProcessSpec) -> Self {
        let ledger = RestartLedger::default();
        Self { spec, generation: 0, phase: Phase::Waiting, ledger, fault: None, crash_next: false }
    }

    pub(crate) fn alive(&self) -> Option<&Alive> {
        match &self.phase {
            Phase::Alive(alive) => Some(alive),
            _ => None,
        }
    }

    pub(crate) fn alive_mut(&mut self) -> Option<&mut Alive> {
        match &mut self.phase {
            Phase::Alive(alive) => Some(alive),
            _ => None,
        }
    }

    pub(crate) fn is_ready(&self) -> bool {
        self.alive().is_some_and(|alive| alive.ready)
    }

    /// Enters a child that was just started.
    pub(crate) fn started(&mut self, child: RunningChild, now: Duration) {
        let crash_at = std::mem::take(&mut self.crash_next).then_some(now + Self::CRASH_AFTER);
        self.phase = Phase::Alive(Alive {
            child,
            since: now,
            ready: false,
            heard: now,
            overdue: false,
            sentence: None,
            continue_at: None,
            crash_at,
        });
    }

    /// Its death, if it died; it is down from then on.
    pub(crate) fn died(&mut self, now: Duration) -> Option<Death> {
        let status = self.alive_mut()?.child.ended()?;
        let Phase::Alive(alive) = std::mem::replace(&mut self.phase, Phase::Down(now)) else { return None };
        Some(Death {
            pid: alive.child.pid(),
            reason: alive.sentence.unwrap_or_else(|| describe(status)),
            overdue: alive.overdue,
            was_ready: alive.ready,
            voluntary: status.code().is_some(),
            child: alive.child,
        })
    }

    /// True once, when its ready file has appeared.
    pub(crate) fn becomes_ready(&mut self, now: Duration) -> bool {
        if self.alive().is_none_or(|alive| alive.ready) {
            return false;
        }
        let there = self.spec.ready_file(self.generation).exists();
        let Some(alive) = self.alive_mut() else { return false };
        if alive.crash_at.is_some() || alive.sentence.is_some() || !there {
            return false;
        }
        alive.ready = true;
        alive.heard = now;
        true
    }

    /// Kills it when it is overdue, silent or meant to crash; continues it when its pause is over.
    /// Silence counts from `pulses_from` on.
    pub(crate) fn discipline(&mut self, now: Duration, pulses_from: Option<Duration>) {
        let (ready_within, hung_after) = (self.spec.ready_within, self.spec.hung_after);
        let Phase::Alive(alive) = &mut self.phase else { return };
        if alive.continue_at.is_some_and(|due| now >= due) {
            alive.continue_at = None;
            alive.child.signal(Signal::CONT);
            self.fault = None;
        }
        if alive.crash_at.is_some_and(|due| now >= due) {
            alive.crash_at = None;
            alive.condemn("killed before it was ready: injected crash-on-start".into());
        }
        if !alive.ready && now.saturating_sub(alive.since) > ready_within {
            alive.overdue = true;
            alive.condemn(format!("not ready within {} s", ready_within.as_secs_f64()));
        }
        if let (Some(limit), Some(from)) = (hung_after, pulses_from)
            && alive.ready
            && now.saturating_sub(alive.heard.max(from)) > limit
        {
            alive.condemn(format!("hung: no pulse for more than {} ms", limit.as_millis()));
        }
    }
}

impl Supervised {
    /// Asks it to end, also when it stands still.
    pub(crate) fn ask_to_end(&mut self) {
        if let Some(alive) = self.alive() {
            alive.child.signal(Signal::TERM);
            alive.child.signal(Signal::CONT);
        }
    }

    /// Kills it when its grace is over; `asked` is the time since it was asked.
    pub(crate) fn force_to_end(&mut self, asked: Duration) {
        let grace = self.spec.stop_grace;
        if let Some(alive) = self.alive_mut().filter(|_| asked > grace) {
            alive.condemn(format!("killed: it did not end within {} s", grace.as_secs_f64()));
        }
    }
}

impl Alive {
    /// Kills it, once, for this reason.
    fn condemn(&mut self, reason: String) {
        if self.sentence.is_none() {
            self.sentence = Some(reason);
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

/// The signals that one meets, by their usual names.
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
