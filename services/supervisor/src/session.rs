use crate::control_socket::ControlSocket;
use crate::kept_messages::KeptMessages;
use crate::launch::{Ending, Launch};
use crate::observer::Observer;
use crate::{Injection, LaunchError, Note, ProcessSet, Progress, Refusal, Terminal, Tone, clock, scheduling};
use coact_pipeline::Run;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A run in progress.
pub(crate) struct Session<'a> {
    launch: &'a Launch,
    run: &'a Run,
    terminal: &'a Terminal,
    // Stopped (dropped) before the topics are let go.
    set: ProcessSet,
    observer: Observer,
    kept: KeptMessages,
    socket: ControlSocket,
    progress: Progress,
    /// Faults still to come, the next one last.
    injections: Vec<Injection>,
    interrupted: Arc<AtomicBool>,
    /// Release of tick 0, once the whole set was ready.
    start: Option<Duration>,
    achieved_at: Option<Duration>,
    /// When the status is shown next.
    status_at: Duration,
}

/// A death is noticed at once; all else is looked at so often.
const LOOK_EVERY: Duration = Duration::from_millis(2);
/// From "all are ready" to tick 0: every process has seen the start by then.
const LEAD: Duration = Duration::from_millis(50);
/// How long the set goes on after the last subgoal: long enough to see the robot rest.
const AFTERGLOW: Duration = Duration::from_secs(2);

impl<'a> Session<'a> {
    /// Prepares everything that the processes need; starts none.
    pub(crate) fn open(
        launch: &'a Launch,
        run: &'a Run,
        set: ProcessSet,
        terminal: &'a Terminal,
    ) -> Result<Self, LaunchError> {
        let interrupted = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM, SIGHUP] {
            signal_hook::flag::register(signal, Arc::clone(&interrupted)).map_err(LaunchError::Signals)?;
        }
        let kept = KeptMessages::hold(run, &launch.pipeline)?;
        let observer = Observer::new(kept.bus(), &launch.pipeline)?;
        let socket = ControlSocket::open(run)
            .map_err(|source| LaunchError::File { path: run.directory().to_owned(), source })?;
        let mut injections = launch.injections.clone();
        injections.sort_by_key(|injection| std::cmp::Reverse(injection.at));
        Ok(Self {
            launch,
            run,
            terminal,
            set,
            observer,
            kept,
            socket,
            progress: Progress::new(&launch.task),
            injections,
            interrupted,
            start: None,
            achieved_at: None,
            status_at: Duration::ZERO,
        })
    }

    /// Starts the set, stays with it until its end, and stops it.
    pub(crate) fn attend(mut self) -> Result<Ending, LaunchError> {
        scheduling::stand_by();
        let ending = self.watch();
        self.show();
        self.terminal.status("stopping".into());
        let Self { set, kept, .. } = &mut self;
        set.stop(|| kept.poll());
        self.show_news();
        ending
    }

    fn watch(&mut self) -> Result<Ending, LaunchError> {
        loop {
            self.set.wait(LOOK_EVERY);
            self.set.replace_dead(&mut self.kept)?;
            self.kept.poll();
            self.observer.poll(&mut self.set, &mut self.progress);
            self.set.advance(&mut self.kept)?;
            self.start_clock()?;
            self.inject();
            self.show();
            if let Some(ending) = self.ending() {
                return Ok(ending);
            }
        }
    }

    /// Starts the run's clock as soon as all processes are ready for the first time.
    fn start_clock(&mut self) -> Result<(), LaunchError> {
        if self.start.is_some() || !self.set.all_ready() {
            return Ok(());
        }
        let start = clock::now() + LEAD;
        self.run.start(clock::stamp(start))?;
        self.set.expect_pulses(start);
        self.start = Some(start);
        self.warn_of_lacking_privileges();
        Ok(())
    }

    /// In red: which process runs without the scheduling or the locked memory that it asked for.
    fn warn_of_lacking_privileges(&mut self) {
        for entry in &self.launch.pipeline.processes {
            let Ok(Some(ready)) = self.run.ready(&entry.name, 0) else { continue };
            if !ready.why_not.is_empty() {
                let refused = ready.why_not.join("; ");
                let text =
                    format!("{} is not real time: {refused}; see rt-config/system/README.md", entry.name);
                self.progress.note(Note::new(Tone::Alarm, text));
            }
        }
    }

    /// Time since tick 0.
    fn elapsed(&self) -> Option<Duration> {
        Some(clock::now().saturating_sub(self.start?))
    }

    fn inject(&mut self) {
        while let Some(request) = self.socket.next() {
            let outcome = self.set.inject(&request.process, request.fault);
            request.answer(outcome);
        }
        let Some(elapsed) = self.elapsed() else { return };
        while let Some(injection) = self.injections.pop_if(|injection| injection.at <= elapsed) {
            match self.set.inject(&injection.process, injection.fault) {
                // It is being restarted: the fault waits for it.
                Err(Refusal::NotRunning(_)) => {
                    self.injections.push(injection);
                    return;
                }
                Err(refusal) => self.progress.note(Note::new(Tone::Alarm, refusal.to_string())),
                Ok(()) => {}
            }
        }
    }

    fn show(&mut self) {
        if self.show_news() || clock::now() >= self.status_at {
            self.status_at = clock::now() + Duration::from_secs(1);
            let status = self.elapsed().map(|elapsed| self.progress.status(elapsed));
            self.terminal.status(status.unwrap_or_else(|| self.waiting()));
        }
    }

    /// Answers whether anything happened to a process.
    fn show_news(&mut self) -> bool {
        let news = self.set.take_news();
        for event in &news {
            self.progress.event(event);
        }
        for note in self.progress.take_notes() {
            self.terminal.note(match self.elapsed() {
                Some(elapsed) => note.at(elapsed),
                None => note,
            });
        }
        !news.is_empty()
    }

    /// For whom the start of the run waits.
    fn waiting(&self) -> String {
        format!("starting; not ready yet: {}", self.set.not_ready().collect::<Vec<_>>().join(", "))
    }

    fn ending(&mut self) -> Option<Ending> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Some(Ending::Interrupted);
        }
        let elapsed = self.elapsed()?;
        if let Some(duration) = self.launch.duration {
            return (elapsed >= duration).then_some(Ending::DurationOver);
        }
        if self.achieved_at.is_none() && self.progress.all_achieved() {
            self.achieved_at = Some(elapsed);
        }
        match self.achieved_at {
            Some(at) if elapsed >= at + AFTERGLOW => Some(Ending::Achieved),
            _ => (elapsed >= Launch::LONGEST).then_some(Ending::TooLong),
        }
    }
}
