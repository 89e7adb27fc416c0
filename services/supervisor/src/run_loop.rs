use crate::control_socket::{ControlSocket, SetRequest, Wanted};
use crate::ending::EndCondition;
use crate::operator::Operator;
use crate::operator_stop::OperatorStop;
use crate::run_topics::RunTopics;
use crate::service_manager::ServiceManager;
use crate::topic_reader::TopicReader;
use crate::{
    Ending, Injection, InjectionRefusal, LaunchError, Note, NoteKind, ProcessSet, RunProgress, StopRequest,
    Terminal,
};
use coact_pipeline::{Pipeline, Run};
use coact_realtime::{Schedule, SchedulingClass, monotonic_time};
use coact_run_records::SupervisorEventKind;
use signal_hook::consts::{SIGCHLD, SIGHUP, SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// What a run consists of, before anything is started.
pub(crate) struct RunParts<'a> {
    pub(crate) run: &'a Run,
    pub(crate) pipeline: &'a Pipeline,
    pub(crate) terminal: &'a Terminal,
    pub(crate) set: ProcessSet,
    pub(crate) progress: RunProgress,
    pub(crate) injections: Vec<Injection>,
    pub(crate) end: EndCondition,
    /// Of a run whose supervisor has died: whether its robot is to stand, or may go on.
    pub(crate) adopted: Option<StopRequest>,
}

/// A run in progress: does in turn all that has to be done until its end.
pub(crate) struct RunLoop<'a> {
    run: &'a Run,
    pipeline: &'a Pipeline,
    terminal: &'a Terminal,
    // Stopped (dropped) before the topics are closed.
    set: ProcessSet,
    reader: TopicReader,
    stop: OperatorStop,
    topics: RunTopics,
    socket: ControlSocket,
    progress: RunProgress,
    /// Faults that are still to come, the next one last.
    injections: Vec<Injection>,
    end: EndCondition,
    interrupted: Arc<AtomicBool>,
    /// Since the last look a child was stopped, continued or has died: the signal that tells so ends the wait.
    child_changed: Arc<AtomicBool>,
    /// Release of tick 0, once the whole set was ready.
    start: Option<Duration>,
    service_manager: ServiceManager,
    /// When the status is shown next.
    status_at: Duration,
}

/// A death wakes the supervisor at once, and so does a stop; everything else is looked at this often. A trade-off between how soon
/// a hang is found and the supervisor's load.
const POLL_INTERVAL: Duration = Duration::from_millis(1);
/// The same while a process starts, which waits for its checkpoint so long at most once it can take it, and while one is stopped or may
/// sleep for ever, which is to be replaced. Chosen by hand.
const POLL_CLOSELY: Duration = Duration::from_micros(500);
/// From "all are ready" to tick 0. Every process polls for the start once in a millisecond: all have seen it by then, also
/// on a busy machine.
const START_DELAY: Duration = Duration::from_millis(50);
/// How often the status line is renewed when nothing happens.
const STATUS_INTERVAL: Duration = Duration::from_secs(1);
/// SCHED_FIFO priority of the supervisor: above the processes that are not ready yet (1), below those that are. So a death
/// is noticed on a busy machine, too, and no cycle waits for the supervisor.
const PRIORITY: u8 = 2;

impl<'a> RunLoop<'a> {
    /// Prepares everything that the processes need; starts none, but takes over those of an adopted run.
    pub(crate) fn prepare(parts: RunParts<'a>) -> Result<Self, LaunchError> {
        let RunParts { run, pipeline, terminal, set, progress, mut injections, end, adopted } = parts;
        let interrupted = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM, SIGHUP] {
            signal_hook::flag::register(signal, Arc::clone(&interrupted)).map_err(LaunchError::Signals)?;
        }
        let child_changed = Arc::new(AtomicBool::new(false));
        signal_hook::flag::register(SIGCHLD, Arc::clone(&child_changed)).map_err(LaunchError::Signals)?;
        let topics = RunTopics::create(run, pipeline, run.owner()?.generation)?;
        let reader = TopicReader::new(topics.bus(), pipeline)?;
        let stop = OperatorStop::new(topics.bus())?;
        let socket = ControlSocket::open(run)
            .map_err(|cause| LaunchError::File { path: run.directory().to_owned(), cause })?;
        injections.sort_by_key(|injection| std::cmp::Reverse(injection.at));
        let mut run_loop = Self {
            run,
            pipeline,
            terminal,
            set,
            reader,
            stop,
            topics,
            socket,
            progress,
            injections,
            end,
            interrupted,
            child_changed,
            start: None,
            service_manager: ServiceManager::from_environment(),
            status_at: Duration::ZERO,
        };
        if let Some(wanted) = adopted {
            run_loop.take_over(wanted)?;
        }
        Ok(run_loop)
    }

    /// Goes on with a run whose supervisor has died. Nobody has heard whether an operator had stopped the robot: so it stands, unless
    /// the operator who adopts wants something else.
    fn take_over(&mut self, wanted: StopRequest) -> Result<(), LaunchError> {
        // What may be refused comes first: the set is still nobody's then, and can be adopted again.
        self.topics.reserve_memory()?;
        let start = self.run.start_ns()?.map(Duration::from_nanos);
        self.start = start;
        let operator = Operator::own();
        self.set.record_operator(SupervisorEventKind::Adopted, operator);
        let changed = match wanted {
            StopRequest::Stop => self.stop.request(wanted, operator, self.schedule()),
            StopRequest::Resume => Ok(SupervisorEventKind::OperatorResumed),
        };
        changed.into_iter().for_each(|changed| self.set.record_operator(changed, operator));
        let run = self.run;
        self.set.adopt(|process| run.newest_ready(process).ok().flatten());
        start.into_iter().for_each(|start| self.set.expect_pulses(start));
        self.service_manager.run_begins();
        self.show_events();
        Ok(())
    }

    /// Starts the set, supervises it until the run's end, and stops it.
    pub(crate) fn run(mut self) -> Result<Ending, LaunchError> {
        // What it starts inherits the class: a replacement is needed soon.
        if let Err(error) = SchedulingClass::Fifo(PRIORITY).apply() {
            tracing::debug!("the supervisor runs without SCHED_FIFO: {error}");
        }
        let ending = self.supervise();
        self.show();
        self.terminal.status("stopping".into());
        self.service_manager.run_ends();
        let schedule = self.schedule();
        let Self { set, topics, stop, .. } = &mut self;
        set.stop(|| {
            topics.poll();
            stop.repeat(schedule);
        });
        self.show_events();
        ending
    }

    fn supervise(&mut self) -> Result<Ending, LaunchError> {
        loop {
            self.set.wait(if self.looks_closely() { POLL_CLOSELY } else { POLL_INTERVAL });
            self.service_manager.is_alive(monotonic_time());
            self.set.replace_dead(&mut self.topics)?;
            self.topics.poll();
            self.stop.repeat(self.schedule());
            self.reader.poll(&mut self.set, &mut self.progress);
            self.set.advance(&mut self.topics)?;
            self.start_clock()?;
            self.obey();
            self.inject();
            self.show();
            if let Some(ending) = self.ending() {
                return Ok(ending);
            }
        }
    }

    /// Whether a process starts, is stopped, or may sleep for ever.
    fn looks_closely(&self) -> bool {
        let changed = self.child_changed.swap(false, Ordering::Relaxed);
        let stands = changed && self.set.anyone_stands();
        // It is looked for again until none is.
        self.child_changed.fetch_or(stands, Ordering::Relaxed);
        stands || self.set.anyone_starts_or_is_suspected()
    }

    /// Starts the run's clock as soon as every process that it waits for is ready.
    fn start_clock(&mut self) -> Result<(), LaunchError> {
        if self.start.is_some() || !self.set.may_begin() {
            return Ok(());
        }
        self.topics.reserve_memory()?;
        let start = monotonic_time() + START_DELAY;
        self.run.start(start.as_nanos() as u64)?;
        self.set.expect_pulses(start);
        self.start = Some(start);
        self.service_manager.run_begins();
        self.warn_of_missing_privileges();
        Ok(())
    }

    /// In red: which process runs without the scheduling or the locked memory that the process table wants.
    fn warn_of_missing_privileges(&mut self) {
        for entry in &self.pipeline.processes {
            let Ok(Some(ready)) = self.run.ready(&entry.name, 0) else { continue };
            if !ready.why_not.is_empty() {
                let refused = ready.why_not.join("; ");
                let text =
                    format!("{} is not real time: {refused}; see rt-config/system/README.md", entry.name);
                self.progress.note(Note::new(NoteKind::Alarm, text));
            }
        }
    }

    /// Time since tick 0.
    fn elapsed(&self) -> Option<Duration> {
        Some(monotonic_time().saturating_sub(self.start?))
    }

    /// The run's clock, once it runs.
    fn schedule(&self) -> Option<Schedule> {
        self.start.map(|start| Schedule { start_ns: start.as_nanos() as u64 })
    }

    /// Does what operators have asked for.
    fn obey(&mut self) {
        while let Some(SetRequest { operator, wanted, asker }) = self.socket.next() {
            match wanted {
                Wanted::Fault { process, fault } => asker.injected(self.set.inject(&process, fault)),
                Wanted::Stop(wanted) => {
                    let outcome = self.stop.request(wanted, operator, self.schedule());
                    if let Ok(change) = outcome {
                        self.set.record_operator(change, operator);
                    }
                    asker.latched(outcome.err());
                }
            }
        }
    }

    fn inject(&mut self) {
        let Some(elapsed) = self.elapsed() else { return };
        while let Some(injection) = self.injections.pop_if(|injection| injection.at <= elapsed) {
            match self.set.inject(&injection.process, injection.fault) {
                // It is being restarted: the fault waits for it.
                Err(InjectionRefusal::NotRunning(_)) => {
                    self.injections.push(injection);
                    return;
                }
                Err(refusal) => self.progress.note(Note::new(NoteKind::Alarm, refusal.to_string())),
                Ok(()) => {}
            }
        }
    }

    fn show(&mut self) {
        if self.show_events() || monotonic_time() >= self.status_at {
            self.status_at = monotonic_time() + STATUS_INTERVAL;
            let status = self.elapsed().map(|elapsed| self.progress.status(elapsed));
            self.terminal.status(status.unwrap_or_else(|| self.starting_status()));
        }
    }

    /// Returns whether anything happened to a process.
    fn show_events(&mut self) -> bool {
        let events = self.set.take_events();
        for event in &events {
            self.progress.event(event);
        }
        for note in self.progress.take_notes() {
            self.terminal.note(match self.elapsed() {
                Some(elapsed) => note.at(elapsed),
                None => note,
            });
        }
        !events.is_empty()
    }

    /// Which processes the start of the run waits for.
    fn starting_status(&self) -> String {
        format!("starting; not ready yet: {}", self.set.not_ready().collect::<Vec<_>>().join(", "))
    }

    fn ending(&mut self) -> Option<Ending> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Some(Ending::Interrupted);
        }
        let elapsed = self.elapsed()?;
        self.end.check(elapsed, self.progress.all_achieved())
    }
}
