use crate::death::Death;
use crate::fault::Means;
use crate::operator::Operator;
use crate::start_fault::StartFault;
use crate::supervised::{Lifecycle, Supervised};
use crate::watch::Watch;
use crate::{Checkpoints, Fault, GaveUp, InjectionRefusal, ProcessSpec, RunningChild, SupervisorLog};
use coact_pipeline::{Ready, RestartPolicy};
use coact_realtime::monotonic_time;
use coact_run_records::{SupervisorEvent, SupervisorEventKind};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::process::Signal;
use std::collections::BTreeSet;
use std::thread;
use std::time::Duration;

/// A set of processes that are started in order, watched, restarted when they die, and stopped in reverse order.
///
/// Only [`ProcessSet::wait`] and [`ProcessSet::stop`] wait. The owner calls [`ProcessSet::advance`] after each wait, and
/// each call does what is due by then.
pub struct ProcessSet {
    processes: Vec<Supervised>,
    policy: RestartPolicy,
    log: SupervisorLog,
    new_events: Vec<SupervisorEvent>,
    watch: Watch,
    /// Called with process name and line for each line that a process writes to standard error.
    on_line: LineSink,
}

/// Receives process name and line; cloned into each process's reader.
pub type LineSink = std::sync::Arc<dyn Fn(&str, &str) + Send + Sync>;

impl ProcessSet {
    /// How often a stopping set is looked at when no process ends. Chosen by hand; not sensitive.
    const STOP_POLL: Duration = Duration::from_millis(3);
    /// Shortest pause before a replacement that found no place is started again. Chosen by hand: long enough to leave the
    /// core to the survivors.
    const PLACE_POLL: Duration = Duration::from_millis(10);

    /// A set of which nothing runs yet.
    pub fn new(
        specs: Vec<ProcessSpec>,
        policy: RestartPolicy,
        log: SupervisorLog,
        on_line: LineSink,
    ) -> Self {
        let mut processes: Vec<_> = specs.into_iter().map(Supervised::new).collect();
        processes.sort_by_key(|process| process.spec.order);
        Self { processes, policy, log, new_events: Vec::new(), watch: Watch::default(), on_line }
    }

    /// Takes over what a dead supervisor has started: `newest` is what each process reported last. Those that have died since are
    /// replaced.
    pub(crate) fn adopt(&mut self, newest: impl Fn(&str) -> Option<Ready>) {
        for index in 0..self.processes.len() {
            let name = self.processes[index].spec.name.clone();
            // What was never ready is started as if for the first time.
            let Some(ready) = newest(&name) else { continue };
            let sink = self.on_line.clone();
            match RunningChild::adopt(&ready, move |line| sink(&name, line)) {
                Some(child) => {
                    let watched = self.watch.watched();
                    self.processes[index].adopted(child, &ready, monotonic_time(), watched);
                }
                None => self.found_dead(index, &ready),
            }
        }
    }

    /// A process died while nobody supervised it. That is one death, whatever its policy: its replacement is due at once.
    fn found_dead(&mut self, index: usize, ready: &Ready) {
        let process = &mut self.processes[index];
        (process.generation, process.died_unseen) = (ready.generation, true);
        process.history.died_and_returns(&self.policy, monotonic_time());
        process.lifecycle = Lifecycle::RestartDue(monotonic_time());
        let reason = "found dead: it ended while the run had no supervisor".to_owned();
        self.record(index, SupervisorEventKind::Died, Some(ready.pid), Some(reason));
    }

    /// Waits until a process dies, a signal arrives, or `limit` has passed.
    pub fn wait(&self, limit: Duration) {
        let children = self.processes.iter().filter_map(|process| process.running());
        let mut deaths: Vec<PollFd<'_>> =
            children.map(|running| PollFd::from_borrowed_fd(running.child.death(), PollFlags::IN)).collect();
        let until = Timespec { tv_sec: limit.as_secs() as i64, tv_nsec: limit.subsec_nanos().into() };
        match poll(&mut deaths, Some(&until)) {
            // The caller looks for an interrupting signal anyway.
            Ok(_) | Err(Errno::INTR) => {}
            // The kernel lets nobody wait who may have no file handles; looking without end would keep the core from others.
            Err(_) => thread::sleep(limit),
        }
    }

    /// Handles every exit, and starts the processes whose turn has come. To be called right after [`ProcessSet::wait`], so
    /// that replacements are started before anything else is done.
    ///
    /// # Errors
    /// The set was given up; what still runs is stopped by [`ProcessSet::stop`].
    pub fn replace_dead(&mut self, checkpoints: &mut dyn Checkpoints) -> Result<(), GaveUp> {
        for index in 0..self.processes.len() {
            if let Some(death) = self.processes[index].died(monotonic_time()) {
                self.on_exit(index, death, checkpoints)?;
            }
            self.start_if_due(index, checkpoints)?;
        }
        Ok(())
    }

    /// Does everything that is due: replaces the dead, notes who is ready, and lets the watchdog kill the hung.
    ///
    /// # Errors
    /// As [`ProcessSet::replace_dead`].
    pub fn advance(&mut self, checkpoints: &mut dyn Checkpoints) -> Result<(), GaveUp> {
        self.replace_dead(checkpoints)?;
        for index in 0..self.processes.len() {
            if self.processes[index].becomes_ready(monotonic_time(), self.watch.watched()) {
                self.on_ready(index, checkpoints);
            }
            self.processes[index].look(monotonic_time());
        }
        let looked_at_all = self.watch.look(&mut self.processes);
        if looked_at_all && self.watch.run_has_begun() {
            self.keep_spares();
        }
        Ok(())
    }

    /// Starts the spares that are missing. Not before the run's clock runs: what is needed first is started first.
    fn keep_spares(&mut self) {
        let now = monotonic_time();
        for process in &mut self.processes {
            let (sink, name) = (self.on_line.clone(), process.spec.name.clone());
            process.keep_spare(now, move |line| sink(&name, line));
        }
    }

    /// The run's clock starts at `from`: pulses are expected from then on.
    pub fn expect_pulses(&mut self, from: Duration) {
        self.watch.expect_pulses(from);
    }

    /// A process published a pulse: it is not hung.
    pub fn pulse(&mut self, process: &str) {
        let watched = self.watch.watched();
        let running =
            self.processes.iter_mut().find(|p| p.spec.name == process).and_then(Supervised::running_mut);
        // What a dead predecessor sent last says nothing of its replacement.
        if let Some(running) = running.filter(|running| running.ready) {
            running.pulse(watched);
        }
    }

    /// Injects a fault into a running process.
    ///
    /// # Errors
    /// There is no such process, or it is not running just now.
    pub fn inject(&mut self, process: &str, fault: Fault) -> Result<(), InjectionRefusal> {
        let names = || self.names().map(str::to_owned).collect();
        let index = self.processes.iter().position(|p| p.spec.name == process);
        let index =
            index.ok_or_else(|| InjectionRefusal::UnknownProcess { name: process.into(), known: names() })?;
        if let Some(only) = fault.only_of().filter(|only| *only != process) {
            return Err(InjectionRefusal::OtherProcess { fault, process: process.into(), only });
        }
        if !self.processes[index].is_ready() {
            return Err(InjectionRefusal::NotRunning(process.into()));
        }
        self.processes[index].fault = Some(fault);
        let kind = match fault.is_latent() {
            true => SupervisorEventKind::InjectedLatent,
            false => SupervisorEventKind::Injected,
        };
        self.record(index, kind, None, None);
        let target = &mut self.processes[index];
        target.start_fault = StartFault::after(fault);
        let Some(running) = target.running_mut() else { return Ok(()) };
        match fault.means() {
            Means::Signal(signal) => running.child.signal(signal),
            Means::Pause(pause) => {
                running.child.signal(Signal::STOP);
                running.continue_at = Some(monotonic_time() + pause);
            }
            Means::Request(request) => running.child.request(request),
            Means::NoHandles => running.child.refuse_handles(),
        }
        if !fault.is_recovered_from_by_a_replacement() {
            target.fault = None;
        }
        Ok(())
    }

    /// True while a process runs that is not ready yet, or may hang.
    pub(crate) fn anyone_starts_or_is_suspected(&self) -> bool {
        self.processes
            .iter()
            .filter_map(Supervised::running)
            .any(|running| !running.ready || running.is_suspected())
    }

    /// True while a process is stopped, by a signal.
    pub(crate) fn anyone_stands(&self) -> bool {
        self.processes.iter().filter_map(Supervised::running).any(|running| running.child.is_stopped())
    }

    /// True while every process is ready.
    pub fn all_ready(&self) -> bool {
        self.processes.iter().all(Supervised::is_ready)
    }

    /// True when the run may begin: every process is ready, except those that are not needed and have died already.
    pub fn may_begin(&self) -> bool {
        self.processes.iter().all(Supervised::keeps_nobody_waiting)
    }

    /// Names of those that are not ready.
    pub fn not_ready(&self) -> impl Iterator<Item = &str> {
        self.processes.iter().filter(|process| !process.is_ready()).map(|process| process.spec.name.as_str())
    }

    /// Logs what an operator has done to the whole set.
    pub(crate) fn record_operator(&mut self, event: SupervisorEventKind, operator: Operator) {
        self.note(SupervisorEvent {
            at_ns: monotonic_time().as_nanos() as u64,
            event,
            process: SupervisorEvent::OPERATOR.to_owned(),
            generation: 0,
            pid: operator.pid,
            fault: None,
            reason: None,
            user: Some(operator.user),
        });
    }

    /// Names of all processes, in starting order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.processes.iter().map(|process| process.spec.name.as_str())
    }

    /// Process id of each running process, by name.
    pub fn pids(&self) -> impl Iterator<Item = (&str, u32)> {
        self.processes.iter().filter_map(|p| Some((p.spec.name.as_str(), p.running()?.child.pid())))
    }

    /// What happened since the last call.
    pub fn take_events(&mut self) -> Vec<SupervisorEvent> {
        std::mem::take(&mut self.new_events)
    }

    /// Stops all in descending order, equal ones together: SIGTERM, and SIGKILL when the grace is over.
    /// Calls `meanwhile` every few milliseconds.
    pub fn stop(&mut self, mut meanwhile: impl FnMut()) {
        let orders: BTreeSet<u32> = self.processes.iter().map(|process| process.spec.order).collect();
        for &order in orders.iter().rev() {
            let group = |set: &Self, i: usize| set.processes[i].spec.order == order;
            let group: Vec<usize> = (0..self.processes.len()).filter(|&i| group(self, i)).collect();
            self.stop_together(&group, &mut meanwhile);
        }
    }

    fn stop_together(&mut self, group: &[usize], meanwhile: &mut impl FnMut()) {
        let begin = monotonic_time();
        for &index in group {
            self.processes[index].spare = None;
            self.record(index, SupervisorEventKind::StopRequested, None, None);
            self.processes[index].request_stop();
        }
        while group.iter().any(|&index| self.processes[index].running().is_some()) {
            self.reap(group);
            for &index in group {
                self.processes[index].kill_after_grace(monotonic_time().saturating_sub(begin));
            }
            meanwhile();
            self.wait(Self::STOP_POLL);
        }
        for &index in group {
            self.processes[index].lifecycle = Lifecycle::Stopped;
        }
    }

    /// Takes in the dead while the set stops, those too whose turn has not come: waiting for others would return at once for
    /// the sake of one that is dead already, and keep this core from them.
    fn reap(&mut self, stopping: &[usize]) {
        for index in 0..self.processes.len() {
            if let Some(Death { pid, reason, child, .. }) = self.processes[index].died(monotonic_time()) {
                child.wait_until_gone();
                let was_asked = stopping.contains(&index);
                let kind = if was_asked { SupervisorEventKind::Stopped } else { SupervisorEventKind::Died };
                self.record(index, kind, Some(pid), Some(reason));
                self.processes[index].lifecycle = Lifecycle::Stopped;
            }
        }
    }

    /// Logs a death. A first start that failed gives the set up; otherwise the restart policy decides.
    fn on_exit(&mut self, index: usize, death: Death, checkpoints: &dyn Checkpoints) -> Result<(), GaveUp> {
        let of_its_state = self.processes[index].died_of_its_state(&death);
        let Death { pid, mut reason, was_ready, not_ready_in_time, exited, child, .. } = death;
        // Whoever finds no place ends by itself: one that was killed may die in a crowd, but not of it.
        let kept_out = exited && !was_ready;
        let crowd = if kept_out { checkpoints.crowd(&self.processes[index].spec.name) } else { None };
        if let Some(crowd) = &crowd {
            reason = format!("{reason}; {crowd}");
        }
        self.processes[index].begins_anew = of_its_state && crowd.is_none();
        self.record(index, SupervisorEventKind::Died, Some(pid), Some(reason.clone()));
        let Supervised { spec, generation, .. } = &self.processes[index];
        if spec.needed && *generation == 0 && !was_ready && (exited || not_ready_in_time) {
            return Err(self.give_up(index, pid, reason, child.stderr_tail(), true));
        }
        if crowd.is_some() {
            self.wait_for_place(index);
            return Ok(());
        }
        self.schedule_restart(index, pid, &reason, || child.stderr_tail())
    }

    /// Schedules a replacement that was kept out by others, or by what the system lacks: however often that happens, the set is not given up for it.
    fn wait_for_place(&mut self, index: usize) {
        let now = monotonic_time();
        let process = &mut self.processes[index];
        let pause = process.refusals.died_and_returns(&self.policy, now).max(Self::PLACE_POLL);
        process.lifecycle = Lifecycle::RestartDue(now + pause);
    }

    /// Schedules the replacement when the restart policy allows one, and gives the set up when it does not. What is not
    /// needed is always replaced, after pauses that grow.
    fn schedule_restart(
        &mut self,
        index: usize,
        pid: u32,
        reason: &str,
        stderr_tail: impl FnOnce() -> Vec<String>,
    ) -> Result<(), GaveUp> {
        let now = monotonic_time();
        let RestartPolicy { intensity, window, .. } = self.policy;
        let process = &mut self.processes[index];
        let pause = match process.spec.needed {
            true => process.history.died(&self.policy, now),
            false => Some(process.history.died_and_returns(&self.policy, now)),
        };
        if let Some(pause) = pause {
            process.lifecycle = Lifecycle::RestartDue(now + pause);
            return Ok(());
        }
        let allowed = format!("{intensity} restarts within {} s are allowed", window.as_secs_f64());
        Err(self.give_up(index, pid, format!("{reason}; not restarted: {allowed}"), stderr_tail(), false))
    }

    fn give_up(
        &mut self,
        index: usize,
        pid: u32,
        reason: String,
        stderr_tail: Vec<String>,
        configuration: bool,
    ) -> GaveUp {
        self.record(index, SupervisorEventKind::GaveUp, Some(pid), Some(reason.clone()));
        GaveUp { process: self.processes[index].spec.name.clone(), reason, stderr_tail, configuration }
    }

    fn on_ready(&mut self, index: usize, checkpoints: &mut dyn Checkpoints) {
        self.record(index, SupervisorEventKind::Ready, None, None);
        let process = &mut self.processes[index];
        if process.generation > 0 {
            process.fault = None;
            checkpoints.recovered(&process.spec.name);
        }
    }

    /// Starts a process whose turn has come, or a replacement that is due.
    fn start_if_due(&mut self, index: usize, checkpoints: &mut dyn Checkpoints) -> Result<(), GaveUp> {
        let process = &self.processes[index];
        let kind = match process.lifecycle {
            Lifecycle::Waiting if self.is_turn_of(process.spec.order) => SupervisorEventKind::Started,
            Lifecycle::RestartDue(due) if monotonic_time() >= due => SupervisorEventKind::Restarted,
            _ => return Ok(()),
        };
        if kind == SupervisorEventKind::Restarted {
            self.resume(index, checkpoints);
        }
        self.spawn(index, kind)
    }

    /// Makes the checkpoint ready for the replacement; none when its predecessor died of it, and says what is lost.
    fn resume(&mut self, index: usize, checkpoints: &mut dyn Checkpoints) {
        let Supervised { spec, begins_anew, .. } = &self.processes[index];
        let (begins_anew, name) = (*begins_anew, spec.name.clone());
        let mut lost = if begins_anew { checkpoints.drop_newest(&name) } else { None };
        if self.processes[index].fault == Some(Fault::PoisonedResume) {
            checkpoints.poison(&name);
        }
        let missing = checkpoints.publish(&name);
        let process = &mut self.processes[index];
        if std::mem::take(&mut process.died_unseen) {
            lost = missing.map(|lost| format!("nobody kept its state when it died; lost: {lost}"));
        }
        process.generation += 1;
        process.resumed = !begins_anew;
        if lost.is_some() {
            self.record(index, SupervisorEventKind::StateDropped, Some(0), lost);
        }
    }

    /// True when no process that is to be started before this order has to be waited for.
    fn is_turn_of(&self, order: u32) -> bool {
        let mut before = self.processes.iter().filter(|process| process.spec.order < order);
        before.all(Supervised::keeps_nobody_waiting)
    }

    fn spawn(&mut self, index: usize, kind: SupervisorEventKind) -> Result<(), GaveUp> {
        let Self { processes, on_line, .. } = self;
        let process = &mut processes[index];
        let (sink, name) = (on_line.clone(), process.spec.name.clone());
        match process.next(move |line| sink(&name, line)) {
            Ok(child) => {
                process.started(child, monotonic_time());
                self.record(index, kind, None, None);
                Ok(())
            }
            Err(error) => {
                let reason = format!("cannot start {}: {error}", process.spec.program.display());
                self.record(index, SupervisorEventKind::Died, Some(0), Some(reason.clone()));
                if kind == SupervisorEventKind::Restarted && is_shortage(&error) {
                    self.wait_for_place(index);
                    return Ok(());
                }
                self.schedule_restart(index, 0, &reason, Vec::new)
            }
        }
    }

    /// Logs an event, and keeps it for [`ProcessSet::take_events`]. Without `pid`: that of the running child.
    fn record(&mut self, index: usize, event: SupervisorEventKind, pid: Option<u32>, reason: Option<String>) {
        let process = &self.processes[index];
        let pid = pid.or_else(|| process.running().map(|running| running.child.pid())).unwrap_or(0);
        let event = SupervisorEvent {
            at_ns: monotonic_time().as_nanos() as u64,
            event,
            process: process.spec.name.clone(),
            generation: process.generation,
            pid,
            fault: process.fault.map(|fault| fault.name().to_owned()),
            reason,
            user: None,
        };
        self.note(event);
    }

    /// Logs an event, and keeps it for [`ProcessSet::take_events`].
    fn note(&mut self, event: SupervisorEvent) {
        self.log.write(event.clone());
        self.new_events.push(event);
    }
}

/// Whether the system lacks something that it may have again later: that is no fault of the process.
fn is_shortage(error: &std::io::Error) -> bool {
    let shortages = [Errno::MFILE, Errno::NFILE, Errno::AGAIN, Errno::NOMEM, Errno::NOSPC];
    shortages.iter().any(|shortage| error.raw_os_error() == Some(shortage.raw_os_error()))
}
