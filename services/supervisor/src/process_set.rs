use crate::supervised::{Death, Phase, Supervised};
use crate::{
    Event, EventKind, EventLog, Fault, GaveUp, ProcessSpec, Refusal, RunningChild, Survivors, clock,
};
use coact_pipeline::RestartPolicy;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::process::Signal;
use std::collections::BTreeSet;
use std::time::Duration;

/// A set of processes that are started in order, watched, restarted when they die, and stopped in reverse order.
///
/// It waits for nothing but [`ProcessSet::wait`]: whoever owns it calls [`ProcessSet::advance`] after each wait,
/// and each call does what is due by then.
pub struct ProcessSet {
    processes: Vec<Supervised>,
    policy: RestartPolicy,
    log: EventLog,
    news: Vec<Event>,
    /// From when on silence counts; none while the run's clock does not run yet.
    pulses_from: Option<Duration>,
    /// Called with process name and line for each line that a process writes to standard error.
    on_line: LineSink,
}

/// Receives process name and line; cloned into each process's reader.
pub type LineSink = std::sync::Arc<dyn Fn(&str, &str) + Send + Sync>;

impl ProcessSet {
    /// A set of which nothing runs yet.
    pub fn new(specs: Vec<ProcessSpec>, policy: RestartPolicy, log: EventLog, on_line: LineSink) -> Self {
        let mut processes: Vec<_> = specs.into_iter().map(Supervised::new).collect();
        processes.sort_by_key(|process| process.spec.order);
        Self { processes, policy, log, news: Vec::new(), pulses_from: None, on_line }
    }

    /// Waits until a process dies, a signal arrives, or `limit` has passed.
    pub fn wait(&self, limit: Duration) {
        let children = self.processes.iter().filter_map(|process| process.alive());
        let mut deaths: Vec<PollFd<'_>> =
            children.map(|alive| PollFd::from_borrowed_fd(alive.child.death(), PollFlags::IN)).collect();
        let limit = Timespec { tv_sec: limit.as_secs() as i64, tv_nsec: limit.subsec_nanos().into() };
        // The only failure is an interrupting signal: the caller looks for it anyway.
        poll(&mut deaths, Some(&limit)).ok();
    }

    /// Buries the dead and starts those whose turn has come, replacements first of all: to be called right after
    /// [`ProcessSet::wait`].
    ///
    /// # Errors
    /// The set was given up; what still runs is stopped by [`ProcessSet::stop`].
    pub fn replace_dead(&mut self, survivors: &mut dyn Survivors) -> Result<(), GaveUp> {
        for index in 0..self.processes.len() {
            if let Some(death) = self.processes[index].died(clock::now()) {
                self.bury(index, death)?;
            }
            self.start_if_due(index, survivors)?;
        }
        Ok(())
    }

    /// Does all that is due: replaces the dead, greets the ready, kills the hung.
    ///
    /// # Errors
    /// As [`ProcessSet::replace_dead`].
    pub fn advance(&mut self, survivors: &mut dyn Survivors) -> Result<(), GaveUp> {
        self.replace_dead(survivors)?;
        for index in 0..self.processes.len() {
            if self.processes[index].becomes_ready(clock::now()) {
                self.greet(index, survivors);
            }
            self.processes[index].discipline(clock::now(), self.pulses_from);
        }
        Ok(())
    }

    /// The run's clock starts at `from`: pulses are due from then on.
    pub fn expect_pulses(&mut self, from: Duration) {
        self.pulses_from = Some(from);
    }

    /// A process published a pulse at `at`: it is alive.
    pub fn heard(&mut self, process: &str, at: Duration) {
        let alive =
            self.processes.iter_mut().find(|p| p.spec.name == process).and_then(Supervised::alive_mut);
        if let Some(alive) = alive {
            alive.heard = alive.heard.max(at);
        }
    }

    /// Injects a fault into a running process.
    ///
    /// # Errors
    /// There is no such process, or it is not running just now.
    pub fn inject(&mut self, process: &str, fault: Fault) -> Result<(), Refusal> {
        let names = || self.names().map(str::to_owned).collect();
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

    /// Names of those that are not.
    pub fn not_ready(&self) -> impl Iterator<Item = &str> {
        self.processes.iter().filter(|process| !process.is_ready()).map(|process| process.spec.name.as_str())
    }

    /// Names of all processes, in starting order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.processes.iter().map(|process| process.spec.name.as_str())
    }

    /// Process id of each running process, by name.
    pub fn pids(&self) -> impl Iterator<Item = (&str, u32)> {
        self.processes.iter().filter_map(|p| Some((p.spec.name.as_str(), p.alive()?.child.pid())))
    }

    /// What happened since the last call.
    pub fn take_news(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.news)
    }

    /// Stops all in descending order, equal ones together: SIGTERM, and SIGKILL when the grace is over. Calls
    /// `meanwhile` every few milliseconds.
    pub fn stop(&mut self, mut meanwhile: impl FnMut()) {
        let orders: BTreeSet<u32> = self.processes.iter().map(|process| process.spec.order).collect();
        for &order in orders.iter().rev() {
            let group = |set: &Self, i: usize| set.processes[i].spec.order == order;
            let group: Vec<usize> = (0..self.processes.len()).filter(|&i| group(self, i)).collect();
            self.stop_together(&group, &mut meanwhile);
        }
    }

    fn stop_together(&mut self, group: &[usize], meanwhile: &mut impl FnMut()) {
        let begin = clock::now();
        for &index in group {
            self.processes[index].ask_to_end();
        }
        while group.iter().any(|&index| self.processes[index].alive().is_some()) {
            for &index in group {
                if let Some(death) = self.processes[index].died(clock::now()) {
                    self.record(index, EventKind::Stopped, Some(death.pid), Some(death.reason));
                }
                self.processes[index].force_to_end(clock::now().saturating_sub(begin));
            }
            meanwhile();
            self.wait(Duration::from_millis(3));
        }
        for &index in group {
            self.processes[index].phase = Phase::Stopped;
        }
    }

    /// Enters a death and decides whether a replacement is started, and when.
    fn bury(&mut self, index: usize, death: Death) -> Result<(), GaveUp> {
        let Death { pid, reason, was_ready, overdue, voluntary, child } = death;
        self.record(index, EventKind::Died, Some(pid), Some(reason.clone()));
        let first_start = self.processes[index].generation == 0 && !was_ready;
        if first_start && (voluntary || overdue) {
            return Err(self.give_up(index, pid, reason, child.last_words(), true));
        }
        self.remedy(index, pid, &reason, || child.last_words())
    }

    /// Asks the policy; gives up when it says so.
    fn remedy(
        &mut self,
        index: usize,
        pid: u32,
        reason: &str,
        last_words: impl FnOnce() -> Vec<String>,
    ) -> Result<(), GaveUp> {
        let now = clock::now();
        let RestartPolicy { intensity, period, .. } = self.policy;
        if let Some(pause) = self.processes[index].ledger.died(&self.policy, now) {
            self.processes[index].phase = Phase::Down(now + pause);
            return Ok(());
        }
        let allowed = format!("{intensity} restarts within {} s are allowed", period.as_secs_f64());
        Err(self.give_up(index, pid, format!("{reason}; not restarted: {allowed}"), last_words(), false))
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
            Phase::Waiting if self.is_turn_of(process.spec.order) => EventKind::Started,
            Phase::Down(due) if clock::now() >= due => EventKind::Restarted,
            _ => return Ok(()),
        };
        if kind == EventKind::Restarted {
            survivors.offer(&process.spec.name);
            self.processes[index].generation += 1;
        }
        self.spawn(index, kind)
    }

    /// True when every process that is to be started before this order is ready.
    fn is_turn_of(&self, order: u32) -> bool {
        self.processes.iter().filter(|process| process.spec.order < order).all(Supervised::is_ready)
    }

    fn spawn(&mut self, index: usize, kind: EventKind) -> Result<(), GaveUp> {
        let Self { processes, on_line, .. } = self;
        let process = &mut processes[index];
        let (sink, name) = (on_line.clone(), process.spec.name.clone());
        match RunningChild::spawn(&process.spec, process.generation, move |line| sink(&name, line)) {
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
