use crate::ending::EndCondition;
use crate::run_loop::{RunLoop, RunParts};
use crate::{
    Ending, Injection, LaunchError, Note, NoteKind, Notes, ProcessSet, ProcessSpec, RunProgress, StopRequest,
    SupervisorLog, Terminal,
};
use coact_joint_task::Task;
use coact_messages::topic;
use coact_pipeline::{Pipeline, ProcessEntry, Run, RunSettings, Trigger};
use coact_run_records::{Event, RunLog, Summary, TaskReport};
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use std::ffi::OsString;
use std::fs::DirBuilder;
use std::os::unix::fs::DirBuilderExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A run that is to be started: everything that was requested, read and checked.
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
    /// Faults to inject.
    pub injections: Vec<Injection>,
}

/// The process that writes the summary.
const MONITOR: &str = "monitor";

/// Removes the run's directory and shared memory when it is dropped; what processes of it still use stays.
struct OwnedRun(Run);

impl Drop for OwnedRun {
    fn drop(&mut self) {
        // The processes still end, or live on to be adopted.
        if std::thread::panicking() {
            return;
        }
        if let Err(error) = self.0.remove() {
            tracing::error!("left behind: {error}");
        }
    }
}

/// Tells the observer that the set has ended, when it is dropped: also when the supervision panics.
struct Ends<'a>(&'a AtomicBool);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Launch {
    /// Longest run without a duration.
    pub const MAX_DURATION: Duration = EndCondition::MAX_DURATION;

    /// Starts the set, supervises it until its end, and leaves nothing of it behind but the report.
    ///
    /// # Errors
    /// [`LaunchError`]: what is missing or wrong, or why the set was given up.
    pub fn run(self) -> Result<Ending, LaunchError> {
        self.run_with_observer(|_, _| ()).map(|(ending, ())| ending)
    }

    /// As [`Launch::run`], with an `observer` on a thread of its own. It gets the run, all of whose topics exist by then,
    /// and a flag that is set once the set has ended.
    ///
    /// # Errors
    /// As [`Launch::run`].
    pub fn run_with_observer<T: Send>(
        self,
        observer: impl FnOnce(&Run, &AtomicBool) -> T + Send,
    ) -> Result<(Ending, T), LaunchError> {
        self.prepare()?;
        tell_of_orphaned_runs();
        let log = self.open_report()?;
        let run = OwnedRun(Run::create(self.settings.clone())?);
        self.supervise(run, log, None, observer)
    }

    /// Takes over an `orphaned` run, whose settings these are, supervises it until its end, and leaves nothing of it behind but the
    /// report. The robot then stands until an operator lets it go on, or goes on at once, as `wanted`.
    ///
    /// # Errors
    /// As [`Launch::run`]; whatever refuses before the run is taken over leaves it to the next one who adopts it.
    pub fn adopt(self, orphaned: &Run, wanted: StopRequest) -> Result<Ending, LaunchError> {
        self.prepare()?;
        let run = OwnedRun(orphaned.adopt()?);
        let log = SupervisorLog::open(&self.settings.report).map_err(LaunchError::Record)?;
        self.supervise(run, log, Some(wanted), |_, _| ()).map(|(ending, ())| ending)
    }

    fn prepare(&self) -> Result<(), LaunchError> {
        self.check()?;
        raise_open_files()?;
        coact_realtime::exclude_real_time_cores(&self.pipeline);
        remove_dead_runs();
        Ok(())
    }

    /// `run` is declared before everything that uses it: removed after all of that has ended.
    fn supervise<T: Send>(
        self,
        run: OwnedRun,
        log: SupervisorLog,
        adopted: Option<StopRequest>,
        observer: impl FnOnce(&Run, &AtomicBool) -> T + Send,
    ) -> Result<(Ending, T), LaunchError> {
        let terminal = Terminal::open();
        let run_loop = RunLoop::prepare(RunParts {
            run: &run.0,
            pipeline: &self.pipeline,
            terminal: &terminal,
            set: self.process_set(&run.0, log, terminal.notes()),
            progress: RunProgress::new(&self.task),
            injections: self.injections.clone(),
            end: EndCondition::new(self.settings.duration),
            adopted,
        })?;
        let over = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let observer = scope.spawn(|| observer(&run.0, &over));
            let ends = Ends(&over);
            let ending = run_loop.run();
            drop(ends);
            self.summarise_unmeasured();
            let observed = observer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            Ok((ending?, observed))
        })
    }

    fn check(&self) -> Result<(), LaunchError> {
        for entry in &self.pipeline.processes {
            let program = self.program(entry);
            if !program.is_file() {
                return Err(LaunchError::MissingProgram { process: entry.name.clone(), program });
            }
            let stage = entry.standby_of.as_deref();
            if let Some(stage) = stage.filter(|stage| topic::standby(stage).as_ref() != Some(&entry.name)) {
                return Err(LaunchError::NoStandby { process: stage.to_owned() });
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

    /// Makes the report directory, closed to others whatever the umask, with an empty log, and without a summary of an earlier run.
    fn open_report(&self) -> Result<SupervisorLog, LaunchError> {
        let report = &self.settings.report;
        let file_error = |path: &Path, cause| LaunchError::File { path: path.to_owned(), cause };
        let folder = DirBuilder::new().recursive(true).mode(0o700).create(report);
        folder.map_err(|error| file_error(report, error))?;
        Summary::remove(report).map_err(LaunchError::Record)?;
        SupervisorLog::create(report).map_err(LaunchError::Record)
    }

    /// Writes the summary that a dead monitor cannot write; the run has an end and a verdict in any case.
    fn summarise_unmeasured(&self) {
        let report = &self.settings.report;
        let has_monitor = self.pipeline.processes.iter().any(|entry| entry.name == MONITOR);
        if !has_monitor || report.join(Summary::FILE).exists() {
            return;
        }
        // Whatever of its log cannot be read is missing in the summary, which says that it is not complete.
        let events = RunLog::<Event>::read(report).unwrap_or_default();
        let task = TaskReport::new(|achieved| self.task.needed(achieved), &events, 0.0);
        let reason = "the monitor wrote no summary: it was dead when the run ended, and nothing but its log of events is \
                      left; supervisor.jsonl says why";
        if let Err(error) = Summary::unmeasured(task, reason.into()).write(report) {
            tracing::error!("no summary: {error}");
        }
    }

    fn process_set(&self, run: &Run, log: SupervisorLog, notes: Notes) -> ProcessSet {
        let spec = |entry: &ProcessEntry| ProcessSpec {
            name: entry.name.clone(),
            order: entry.order,
            needed: entry.needed,
            realtime: entry.realtime,
            core: entry.core,
            spare: entry.spare,
            program: self.program(entry),
            arguments: arguments(run, entry),
            ready_directory: run.directory().join("ready"),
            ready_within: entry.ready_within,
            heartbeat_file: run.heartbeat_file(&entry.name),
            hung_after: (entry.trigger != Trigger::None).then_some(self.pipeline.restart.hung_after),
            stop_grace: entry.stop_grace,
        };
        let specs = self.pipeline.processes.iter().map(spec).collect();
        let on_line = Arc::new(move |process: &str, line: &str| {
            notes.show(Note::new(NoteKind::Plain, format!("{process}: {line}")));
        });
        ProcessSet::new(specs, self.pipeline.restart, log, on_line)
    }
}

fn arguments(run: &Run, entry: &ProcessEntry) -> Vec<OsString> {
    let mut arguments = vec!["--run".into(), run.directory().into()];
    arguments.extend(entry.standby_of.as_ref().map(|_| "--standby".into()));
    arguments
}

/// A supervisor of the shipped table opens 290 files, one that is looked at by viewers some more.
const FEWEST_OPEN_FILES: u64 = 512;

/// Raises the limit of open files as far as that is allowed, for itself and for all that it starts: the usual soft limit of
/// 1024 is for programs that wait with `select`.
fn raise_open_files() -> Result<(), LaunchError> {
    let Rlimit { maximum, .. } = getrlimit(Resource::Nofile);
    if let Some(allowed) = maximum.filter(|allowed| *allowed < FEWEST_OPEN_FILES) {
        return Err(LaunchError::FewOpenFiles { allowed, needed: FEWEST_OPEN_FILES });
    }
    // Refused only beyond the hard limit, which is what is asked for.
    setrlimit(Resource::Nofile, Rlimit { current: maximum, maximum }).ok();
    Ok(())
}

/// They compete for the cores, and one of them may hold the robot.
fn tell_of_orphaned_runs() {
    for run in Run::all().iter().filter(|run| run.is_orphaned()) {
        let id = run.id();
        tracing::warn!(
            "the supervisor of run {id} has died, its processes live on: coact adopt {id} takes them over"
        );
    }
}

/// Removes what runs left behind whose supervisor was killed. Runs that still go on are not touched.
fn remove_dead_runs() {
    for error in Run::remove_dead() {
        tracing::warn!("a dead run's remains: {error}");
    }
}
