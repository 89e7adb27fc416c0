use crate::session::Session;
use crate::{EventLog, Injection, LaunchError, Note, Notes, ProcessSet, ProcessSpec, Terminal, Tone};
use coact_joint_task::Task;
use coact_pipeline::{Pipeline, ProcessEntry, Run, RunSettings, Trigger};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A run that is to be started: all that was asked for, read and checked.
#[derive(Debug)]
pub struct Launch {
    /// What the processes find in the run directory.
    pub settings: RunSettings,
    /// The process table.
    pub pipeline: Pipeline,
    /// The task.
    pub task: Task,
    /// Folder of the programs that the process table names without a folder.
    pub programs: PathBuf,
    /// How long the run lasts; without it, until all subgoals are achieved, [`Launch::LONGEST`] at most.
    pub duration: Option<Duration>,
    /// Faults to inject.
    pub injections: Vec<Injection>,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// Its duration was over.
    DurationOver,
    /// All subgoals were achieved.
    Achieved,
    /// It was to last until all subgoals were achieved, and that took too long.
    TooLong,
    /// Ctrl-C or SIGTERM.
    Interrupted,
}

/// A run's directory and shared memory: gone when this is.
struct Owned(Run);

impl Drop for Owned {
    fn drop(&mut self) {
        if let Err(error) = self.0.remove() {
            tracing::error!("left behind: {error}");
        }
    }
}

impl Launch {
    /// Longest run without a duration.
    pub const LONGEST: Duration = Duration::from_secs(300);

    /// Starts the set, watches it until its end, and leaves nothing of it behind but the report.
    ///
    /// # Errors
    /// [`LaunchError`]: what is missing or wrong, or why the set was given up.
    pub fn run(self) -> Result<Ending, LaunchError> {
        self.run_beside(|_, _| ()).map(|(ending, ())| ending)
    }

    /// As [`Launch::run`], with a `guest` who looks on from a thread of its own: it gets the run, all of whose topics
    /// exist by then, and a flag that is set once the set has ended.
    ///
    /// # Errors
    /// As [`Launch::run`].
    pub fn run_beside<T: Send>(
        self,
        guest: impl FnOnce(&Run, &AtomicBool) -> T + Send,
    ) -> Result<(Ending, T), LaunchError> {
        self.check()?;
        coact_realtime::keep_off_real_time_cores(&self.pipeline);
        remove_dead_runs();
        let report = self.settings.report.clone();
        let file_error = |path: &Path, source| LaunchError::File { path: path.to_owned(), source };
        std::fs::create_dir_all(&report).map_err(|error| file_error(&report, error))?;
        forget_earlier_summary(&report).map_err(|error| file_error(&report, error))?;
        let log =
            EventLog::create(&report).map_err(|error| file_error(&report.join(EventLog::FILE), error))?;
        let terminal = Terminal::open();
        // Declared before all that lives in it: removed after all that has ended.
        let run = Owned(Run::create(self.settings.clone())?);
        let set = self.process_set(&run.0, log, terminal.notes());
        let session = Session::open(&self, &run.0, set, &terminal)?;
        let over = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let guest = scope.spawn(|| guest(&run.0, &over));
            let ending = session.attend();
            over.store(true, Ordering::Relaxed);
            let seen = guest.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            Ok((ending?, seen))
        })
    }

    fn check(&self) -> Result<(), LaunchError> {
        for entry in &self.pipeline.processes {
            let program = self.program(entry);
            if !program.is_file() {
                return Err(LaunchError::MissingProgram { process: entry.name.clone(), program });
            }
        }
        for injection in &self.injections {
            self.pipeline.process(&injection.process)?;
        }
        Ok(())
    }

    fn program(&self, entry: &ProcessEntry) -> PathBuf {
        match entry.program.contains('/') {
            true => PathBuf::from(&entry.program),
            false => self.programs.join(&entry.program),
        }
    }

    fn process_set(&self, run: &Run, log: EventLog, notes: Notes) -> ProcessSet {
        let spec = |entry: &ProcessEntry| ProcessSpec {
            name: entry.name.clone(),
            order: entry.order,
            realtime: entry.realtime,
            program: self.program(entry),
            arguments: vec!["--run".into(), run.directory().into()],
            ready_directory: run.directory().join("ready"),
            ready_within: entry.ready_within,
            hung_after: (entry.trigger != Trigger::None).then_some(self.pipeline.restart.hung_after),
            stop_grace: entry.stop_grace,
        };
        let specs = self.pipeline.processes.iter().map(spec).collect();
        let on_line = Arc::new(move |process: &str, line: &str| {
            notes.show(Note::new(Tone::Plain, format!("{process}: {line}")));
        });
        ProcessSet::new(specs, self.pipeline.restart, log, on_line)
    }
}

/// What is read at the end must be of this run.
fn forget_earlier_summary(report: &Path) -> std::io::Result<()> {
    match std::fs::remove_file(report.join("summary.json")) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Removes what runs left behind whose supervisor was killed. Living runs are none of our business.
fn remove_dead_runs() {
    for run in Run::all().iter().filter(|run| !run.owner_lives()) {
        if let Err(error) = run.remove() {
            tracing::warn!("a dead run's remains: {error}");
        }
    }
}
