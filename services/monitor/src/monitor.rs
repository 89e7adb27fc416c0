use crate::plots::{PlotError, anticipation_timeline, percentile_curve};
use crate::{
    Album, Anticipation, Environment, Event, Faults, Findings, Intentions, Journal, JournalError, Latencies,
    LatencyError, Link, Reaction, Rules, Summary, SupervisorLog, TaskWatch, Tracking,
};
use coact_joint_task::Task;
use coact_messages::{Command, FieldFrame, NONE, Pulse, SensorSample, Speech, Truth};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Name of the journal of events in the report directory.
const EVENTS: &str = "events.jsonl";
/// After as many cycles a frame is no longer waited for: the fields are dead or far behind.
const OVERDUE: u64 = 1000;

/// Everything that a run's report is made of, kept in the report directory while the run goes on.
///
/// A second after anything was seen it is on disk; opening the same directory again goes on from there.
#[derive(Debug)]
pub struct Monitor {
    report: PathBuf,
    task: Task,
    rules: Rules,
    start_ns: u64,
    latencies: Latencies,
    journal: Journal<Event>,
    anticipation: Anticipation,
    watch: TaskWatch,
    faults: Faults,
    tracking: Tracking,
    reaction: Reaction,
    album: Album,
    supervisor: SupervisorLog,
    /// Truths that are younger than the newest frame.
    waiting: VecDeque<Truth>,
    truth: Truth,
}

/// What a monitor watches.
#[derive(Debug, Clone)]
pub struct Watched {
    /// The report directory.
    pub report: PathBuf,
    /// The task.
    pub task: Task,
    /// The goals that its intention layer can infer.
    pub intentions: Intentions,
    /// How the processes stand in the chain.
    pub links: Vec<Link>,
    /// What the run must reach.
    pub rules: Rules,
    /// Start of the run, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
    /// The same instant by the calendar.
    pub started: SystemTime,
}

/// Why a report could not be kept.
#[derive(Debug, thiserror::Error)]
pub enum MonitorError {
    /// Histograms and accounts.
    #[error(transparent)]
    Latency(#[from] LatencyError),
    /// Events and moments.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// Pictures.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// Another file of the report.
    #[error("{path}: {cause}")]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
}

impl Monitor {
    /// Opens the report directory and goes on with what it holds.
    ///
    /// # Errors
    /// A file of the report cannot be read or written.
    pub fn open(watched: Watched) -> Result<Self, MonitorError> {
        let Watched { report, task, intentions, links, rules, start_ns, started } = watched;
        let pulsing = links.iter().map(|link| link.process.clone()).collect();
        let latencies = Latencies::open(&report.join("latency"), links, started)?;
        let journal = Journal::open(&report.join(EVENTS))?;
        let (mut anticipation, mut watch, mut faults) =
            (Anticipation::new(&task, intentions), TaskWatch::new(&task), Faults::new(pulsing));
        let actions = journal.entries().iter().filter_map(Event::as_action);
        anticipation.resume(actions.map(|action| action.action).max().unwrap_or(0));
        watch.resume(journal.entries());
        faults.resume(journal.entries());
        let (supervisor, album) = (SupervisorLog::new(&report), Album::open(&report, &task)?);
        let (waiting, truth) = (VecDeque::new(), nothing_true_yet());
        Ok(Self {
            report,
            task,
            rules,
            start_ns,
            latencies,
            journal,
            anticipation,
            watch,
            faults,
            tracking: Tracking::new(),
            reaction: Reaction::new(),
            album,
            supervisor,
            waiting,
            truth,
        })
    }

    /// Removes what the monitor of an earlier run left in a report directory; nothing else is touched.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub fn clear(report: &Path) -> Result<(), MonitorError> {
        let files = [EVENTS, Album::FILE, "summary.json"].map(|name| report.join(name)).into_iter();
        let folders = [("latency", "hlog"), ("latency", "json"), ("plots", "svg"), ("plots", "png")];
        let inside = folders.into_iter().flat_map(|(folder, extension)| {
            let entries = std::fs::read_dir(report.join(folder)).into_iter().flatten();
            let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
            paths.filter(move |path| path.extension().is_some_and(|own| own == extension))
        });
        for path in files.chain(inside) {
            match std::fs::remove_file(&path) {
                Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => {
                    return Err(MonitorError::File { path, cause });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// One cycle of a process.
    pub fn pulse(&mut self, process: &str, pulse: &Pulse) {
        let lapse = self.latencies.pulse(process, pulse);
        self.faults.pulse(process, pulse, lapse);
    }

    /// What really happens; it is judged once the fields' frame of the same cycle has come, or is overdue.
    pub fn truth(&mut self, truth: &Truth, events: &mut Vec<Event>) {
        self.album.truth(truth);
        self.waiting.push_back(*truth);
        self.catch_up(truth.header.cycle.saturating_sub(OVERDUE), events);
    }

    /// The fields; appends what can be told to `events`.
    pub fn frame(&mut self, frame: &FieldFrame, events: &mut Vec<Event>) {
        self.catch_up(frame.header.cycle, events);
        if frame.task == self.task.fingerprint {
            self.anticipation.frame(frame, events);
            self.watch.frame(frame, &self.truth, events);
        }
    }

    /// What the sensors said.
    pub fn sample(&mut self, sample: &SensorSample) {
        self.album.sample(sample);
    }

    /// What the arm was told to do.
    pub fn command(&mut self, command: &Command) {
        self.album.command(command);
        self.tracking.command(command);
        self.reaction.command(command);
    }

    /// What the robot said.
    pub fn speech(&mut self, speech: &Speech, events: &mut Vec<Event>) {
        self.watch.speech(speech, events);
    }

    /// Reads what the supervisor wrote, settles faults, and keeps events and moments; after each look at the topics.
    ///
    /// # Errors
    /// A file of the report cannot be read or written.
    pub fn keep(&mut self, now_ns: u64, mut events: Vec<Event>) -> Result<(), MonitorError> {
        for event in self.supervisor.news().map_err(|cause| self.error("supervisor.jsonl", cause))? {
            self.faults.supervisor(&event);
        }
        self.faults.settle(now_ns, &mut events);
        self.album.look().map_err(|cause| self.error(Album::FILE, cause))?;
        if events.is_empty() {
            return Ok(());
        }
        self.journal.append(events).map_err(|cause| self.error(EVENTS, cause))
    }

    /// Writes intervals and accounts; once a second.
    ///
    /// # Errors
    /// A file of the report cannot be written.
    pub fn write(&mut self) -> Result<(), MonitorError> {
        Ok(self.latencies.write()?)
    }

    /// Ends the run: writes logs, pictures and `summary.json`.
    ///
    /// # Errors
    /// A file of the report cannot be written.
    pub fn finish(mut self, environment: Environment, now_ns: u64) -> Result<Summary, MonitorError> {
        let mut events = Vec::new();
        self.catch_up(u64::MAX, &mut events);
        self.anticipation.finish(&mut events);
        self.keep(now_ns, events)?;
        let mut open_faults = Vec::new();
        self.faults.finish(&mut open_faults);
        self.keep(now_ns, open_faults)?;
        self.album.finish().map_err(|cause| self.error(Album::FILE, cause))?;
        self.write()?;
        let summary = Summary::new(Findings {
            task: &self.task,
            environment,
            events: self.journal.entries(),
            figures: Some(self.latencies.figures()),
            tracking: self.tracking.report(),
            reaction: self.reaction.report(),
            start_ns: self.start_ns,
            duration_s: now_ns.saturating_sub(self.start_ns) as f64 / 1e9,
            rules: &self.rules,
        });
        write_summary(&self.report, &summary)?;
        self.draw(&summary)?;
        Ok(summary)
    }

    /// Lets the truth catch up with the fields: what was true up to `cycle` is judged now.
    fn catch_up(&mut self, cycle: u64, events: &mut Vec<Event>) {
        while self.waiting.front().is_some_and(|truth| truth.header.cycle <= cycle)
            && let Some(truth) = self.waiting.pop_front()
        {
            self.anticipation.truth(&truth, events);
            self.watch.truth(&truth, events);
            self.truth = truth;
        }
    }

    fn draw(&self, summary: &Summary) -> Result<(), MonitorError> {
        let folder = self.report.join("plots");
        std::fs::create_dir_all(&folder).map_err(|cause| self.error("plots", cause))?;
        for (name, recorder) in self.latencies.figures().histograms() {
            percentile_curve(&name.replace('.', " "), recorder, &folder.join(format!("{name}.svg")))?;
        }
        Ok(anticipation_timeline(&summary.anticipation.events, &folder.join("anticipation.svg"))?)
    }

    fn error(&self, file: &str, cause: std::io::Error) -> MonitorError {
        MonitorError::File { path: self.report.join(file), cause }
    }
}

/// Writes `summary.json` into a report directory.
///
/// # Errors
/// The file cannot be written.
pub fn write_summary(report: &Path, summary: &Summary) -> Result<(), MonitorError> {
    let path = report.join("summary.json");
    serde_json::to_string_pretty(summary)
        .map_err(std::io::Error::from)
        .and_then(|text| std::fs::write(&path, text + "\n"))
        .map_err(|cause| MonitorError::File { path, cause })
}

fn nothing_true_yet() -> Truth {
    Truth { chain: NONE, subgoal: NONE, ..bytemuck::Zeroable::zeroed() }
}
