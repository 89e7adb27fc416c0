use crate::supervised::{Death, Phase, Supervised};
use crate::{
    Event, EventKind, EventLog, Fault, GaveUp, Intensity, ProcessSpec, Refusal, Remedy, RestartLedger,
    RunningChild, Survivors, clock,
};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::process::Signal;
use std::time::Duration;

/// A set of processes that are started in order, watched, restarted when they die, and stopped in reverse order.
///
/// It waits for nothing but [`ProcessSet::wait`]: whoever owns it calls [`ProcessSet::advance`] after each wait,
/// and each call does what is due by then.
pub struct ProcessSet {
    processes: Vec<Supervised>,
    ledger: RestartLedger,
    log: EventLog,
    news: Vec<Event>,
    /// Called with process name and line for each line that a process writes to standard error.
    on_line: LineSink,
}

/// Receives process name and line; cloned into each process's reader.
pub type LineSink = std::sync::Arc<dyn Fn(&str, &str) + Send + Sync>;

impl ProcessSet {
    /// A set of which nothing runs yet. `specs` stand in starting order.
    pub fn new(specs: Vec<ProcessSpec>, intensity: Intensity, log: EventLog, on_line: LineSink) -> Self {
        let processes = specs.into_iter().map(Supervised::new).collect();
        Self { processes, ledger: RestartLedger::new(intensity), log, news: Vec::new(), on_line }
    }

    /// Waits until a process dies, a signal arrives, or `limit` has passed.
    pub fn wait(&self, limit: Duration) {
        let children = self.processes.iter().filter_map(|process| process.alive());
        let mut deaths: Vec<PollFd<'_>> = children
            .map(|alive| PollFd::from_borrowed_fd(alive.child.death(), PollFlags::IN))
            .collect();
        let limit = Timespec { tv_sec: limit.as_secs() as i64, tv_nsec: limit.subsec_nanos().into() };
        // The only failure is an interrupting signal: the caller looks for it anyway.
        poll(&mut deaths, Some(&limit)).ok();
    }

    /// Does all that is due: buries the dead, greets the ready, kills the hung, starts and restarts.
    ///
    /// # Errors
    /// The set was given up; what still runs is stopped by [`ProcessSet::stop`].
    pub fn advance(&mut self, survivors: &mut dyn Survivors) -> Result<(), GaveUp> {
        for index in 0..self.processes.len() {
            if let Some(death) = self.processes[index].died(clock::now()) {
                self.bury(index, death)?;
            }
            if self.processes[index].becomes_ready(clock::now()) {
                self.greet(index, survivors);
            }
            self.processes[index].discipline(clock::now());
            self.start_if_due(index, survivors)?;
        }
        Ok(())
    }

    /// A process published a pulse at `at`: it is alive.
    pub fn heard(&mut self, process: &str, at: Duration) {
        let alive = self.processes.iter_mut().find(|p| p.spec.name == process).and_then(Supervised::alive_mut);
        if let Some(alive) = alive {
            alive.heard = alive.heard.max(at);
        }
    }

    /// Injects a fault into a running process.
    ///
    /// # Errors
    /// There is no such process, or it is not running just now.
    pub fn inject(&mut self, process: &str, fault: Fault) -> Result<(), Refusal> {
        let names = || self.processes.iter().map(|p| p.spec.name.clone()).collect();
        let index = self.processes.iter().position(|p| p.spec.name == process);
        let index = index.ok_or_else(|| Refusal::UnknownProcess { name: process.into(), known: names() })?;
        if !self.processes[index].is_ready() {
            return Err(Refusal::NotRunning(process.into()));
        }
        self.processes[index].fault = Some(fault);
        self.record(index, EventKind::Injected, None, None);
        let target = &mut self.processes[index];
        target.crash_next = fault == Fault::CrashOnStart;
        let Some(alive) = target.alive_mut() else { return Ok(()) };
        match fault {
            Fault::Kill | Fault::CrashOnStart => alive.child.signal(Signal::KILL),
            Fault::Slow => {
                alive.child.signal(Signal::USR1);
                target.fault = None;
            }
            Fault::Stop => {
                alive.child.signal(Signal::STOP);
                alive.continue_at = Some(clock::now() + Fault::PAUSE);
            }
        }
        Ok(())
    }

    /// True while every process is ready.
    pub fn all_ready(&self) -> bool {
        self.processes.iter().all(Supervised::is_ready)
    }

    /// Process id of each running process, by name.
    pub fn pids(&self) -> impl Iterator<Item = (&str, u32)> {
        self.processes.iter().filter_map(|p| Some((p.spec.name.as_str(), p.alive()?.child.pid())))
    }

    /// What happened since the last call.
    pub fn take_news(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.news)
    }

    /// Stops all in reverse order of their start: SIGTERM, and SIGKILL after `grace`. `last` is stopped last of
    /// all: it accounts for the others. Calls `meanwhile` every few milliseconds.
    pub fn stop(&mut self, grace: Duration, last: &str, mut meanwhile: impl FnMut()) {
        let mut order: Vec<usize> = (0..self.processes.len()).rev().collect();
        order.sort_by_key(|&index| self.processes[index].spec.name == last);
        for index in order {
            self.stop_one(index, grace, &mut meanwhile);
        }
    }

    fn stop_one(&mut self, index: usize, grace: Duration, meanwhile: &mut impl FnMut()) {
        let Some(alive) = self.processes[index].alive() else {
            self.processes[index].phase = Phase::Stopped;
            return;
        };
        let pid = alive.child.pid();
        alive.child.signal(Signal::TERM);
        alive.child.signal(Signal::CONT);
        let limit = clock::now() + grace;
        let mut forced = None;
        let death = loop {
            if let Some(death) = self.processes[index].died(clock::now()) {
                break death;
            }
            if clock::now() >= limit && forced.is_none() {
                forced = Some(format!("killed: it did not end within {} s", grace.as_secs_f64()));
                if let Some(alive) = self.processes[index].alive() {
                    alive.child.signal(Signal::KILL);
                }
            }
            self.wait_for(index, Duration::from_millis(5));
            meanwhile();
        };
        self.processes[index].phase = Phase::Stopped;
        self.record(index, EventKind::Stopped, Some(pid), forced.or(Some(death.reason)));
    }

    /// Waits until this one process dies or `limit` has passed.
    fn wait_for(&self, index: usize, limit: Duration) {
        let Some(alive) = self.processes[index].alive() else { return };
        let limit = Timespec { tv_sec: 0, tv_nsec: limit.subsec_nanos().into() };
        poll(&mut [PollFd::from_borrowed_fd(alive.child.death(), PollFlags::IN)], Some(&limit)).ok();
    }

    /// Enters a death and decides whether a replacement is started, and when.
    fn bury(&mut self, index: usize, death: Death) -> Result<(), GaveUp> {
        let Death { pid, reason, was_ready, configuration, child } = death;
        self.record(index, EventKind::Died, Some(pid), Some(reason.clone()));
        let first_start = self.processes[index].generation == 0 && !was_ready;
        let overdue = first_start && reason.starts_with("not ready");
        if (first_start && configuration) || overdue {
            return Err(self.give_up(index, pid, reason, child.last_words(), configuration));
        }
        self.remedy(index, pid, &reason, || child.last_words())
    }

    /// Asks the ledger; gives up when it says so.
    fn remedy(
        &mut self,
        index: usize,
        pid: u32,
        reason: &str,
        last_words: impl FnOnce() -> Vec<String>,
    ) -> Result<(), GaveUp> {
        let now = clock::now();
        match self.ledger.died(index, now) {
            Remedy::RestartAfter(delay) => {
                self.processes[index].phase = Phase::Down(now + delay);
                Ok(())
            }
            Remedy::GiveUp { needed } => {
                let Intensity { restarts, period, .. } = self.ledger.intensity();
                let reason = format!(
                    "{reason}; not restarted: {needed} restarts within {} s, {restarts} are allowed",
                    period.as_secs_f64()
                );
                Err(self.give_up(index, pid, reason, last_words(), false))
            }
        }
    }

    fn give_up(
        &mut self,
        index: usize,
        pid: u32,
        reason: String,
        last_words: Vec<String>,
        configuration: bool,
    ) -> GaveUp {
        self.record(index, EventKind::GaveUp, Some(pid), Some(reason.clone()));
        GaveUp { process: self.processes[index].spec.name.clone(), reason, last_words, configuration }
    }

    fn greet(&mut self, index: usize, survivors: &mut dyn Survivors) {
        self.record(index, EventKind::Ready, None, None);
        let process = &mut self.processes[index];
        if process.generation > 0 {
            process.fault = None;
            survivors.recovered(&process.spec.name);
        }
    }

    /// Starts a process whose turn has come, or the replacement of a dead one.
    fn start_if_due(&mut self, index: usize, survivors: &mut dyn Survivors) -> Result<(), GaveUp> {
        let process = &self.processes[index];
        let kind = match process.phase {
            Phase::Waiting if self.processes[..index].iter().all(Supervised::is_ready) => EventKind::Started,
            Phase::Down(due) if clock::now() >= due => EventKind::Restarted,
            _ => return Ok(()),
        };
        if kind == EventKind::Restarted {
            survivors.offer(&process.spec.name);
            self.processes[index].generation += 1;
        }
        self.spawn(index, kind)
    }

    fn spawn(&mut self, index: usize, kind: EventKind) -> Result<(), GaveUp> {
        let Self { processes, on_line, .. } = self;
        let process = &mut processes[index];
        drop(std::fs::remove_file(&process.spec.ready_file));
        let (sink, name) = (on_line.clone(), process.spec.name.clone());
        match RunningChild::spawn(&process.spec, move |line| sink(&name, line)) {
            Ok(child) => {
                process.started(child, clock::now());
                self.record(index, kind, None, None);
                Ok(())
            }
            Err(error) => {
                let reason = format!("cannot start {}: {error}", process.spec.program.display());
                self.record(index, EventKind::Died, Some(0), Some(reason.clone()));
                self.remedy(index, 0, &reason, Vec::new)
            }
        }
    }

    /// Writes an event down and keeps it as news. Without `pid`: that of the running child.
    fn record(&mut self, index: usize, event: EventKind, pid: Option<u32>, reason: Option<String>) {
        let process = &self.processes[index];
        let pid = pid.or_else(|| process.alive().map(|alive| alive.child.pid())).unwrap_or(0);
        let event = Event {
            at_ns: clock::stamp(clock::now()),
            event,
            process: process.spec.name.clone(),
            generation: process.generation,
            pid,
            fault: process.fault.map(|fault| fault.name().to_owned()),
            reason,
        };
        self.log.write(&event);
        self.news.push(event);
    }
}
