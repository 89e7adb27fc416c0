use crate::blindness::{Blindness, blind_s};
use crate::latencies::replace;
use crate::plots::{anticipation_timeline, gantt, percentile_curve};
use crate::{
    Anticipation, Faults, Findings, JointMotion, Latencies, MonitorError, Reaction, Rules, SnapshotLog,
    TaskWatch, Timeline, Tracking, Waits, Watched,
};
use coact_joint_task::Task;
use coact_messages::{Command, FieldFrame, NONE, Pulse, Refusal, SensorSample, Speech, Truth, topic};
use coact_period::cycles;
use coact_realtime::LateWakeUp;
use coact_run_records::{
    Environment, Event, LogFollower, OperatorStopReport, Record, RunLog, Snapshot, Summary, SupervisorEvent,
    SupervisorEventKind,
};
use coact_separation::SeparationMeter;
use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// After so many cycles a frame is no longer waited for: the fields are dead or far behind. Twice as long as the
/// watchdog lets a silent process live, so that a stall alone changes no judgement.
const OVERDUE: u64 = cycles(Duration::from_secs(1));

/// Name of the file in which a restarted monitor finds how the arm has moved so far, beside the counters.
const MOTION: &str = "latency/motion.json";
/// The same for how near robot and person came.
const SEPARATION: &str = "latency/separation.json";

/// Makes the report of a run, in its directory, while the run goes on.
///
/// What was seen is on disk within a second. A monitor that opens the same directory again goes on from there.
#[derive(Debug)]
pub struct Monitor {
    report: PathBuf,
    task: Task,
    rules: Rules,
    start_ns: u64,
    latencies: Latencies,
    events: RunLog<Event>,
    anticipation: Anticipation,
    watch: TaskWatch,
    waits: Waits,
    timeline: Timeline,
    faults: Faults,
    blindness: Blindness,
    motion: JointMotion,
    separation: SeparationMeter,
    newest_command: Option<Box<Command>>,
    /// Name of the process that commands the arm.
    commanding: Option<String>,
    /// Cycle of the newest command that it, or its standby, told of.
    commanded: u64,
    /// When each process was requested to end, ns of `CLOCK_MONOTONIC`.
    stop_requested: BTreeMap<String, u64>,
    /// What operators did.
    operators: Vec<SupervisorEvent>,
    tracking: Tracking,
    reaction: Reaction,
    snapshots: SnapshotLog,
    supervisor: LogFollower<SupervisorEvent>,
    /// Truths that are younger than the newest frame.
    waiting: VecDeque<Truth>,
    truth: Truth,
    /// Messages that the monitor itself ignored.
    refused: [u32; Refusal::COUNT],
}

impl Monitor {
    /// Opens the report directory and goes on with what is in it.
    ///
    /// # Errors
    /// A file of the report cannot be read or written.
    pub fn open(watched: Watched) -> Result<Self, MonitorError> {
        let Watched {
            report,
            task,
            intentions,
            nodes,
            limits,
            mut separation,
            fresh,
            rules,
            start_ns,
            started,
        } = watched;
        let commanding = nodes.iter().find(|node| node.last).map(|node| node.process.clone());
        let pulsing = nodes.iter().map(|node| node.process.clone()).collect();
        let latencies = Latencies::open(&report.join("latency"), nodes, fresh, started)?;
        let events = RunLog::<Event>::open(&report)?;
        let (mut anticipation, mut watch, mut faults) =
            (Anticipation::new(&task, intentions), TaskWatch::new(&task), Faults::new(pulsing));
        let actions = events.records().iter().filter_map(Event::as_action);
        anticipation.resume(actions.map(|action| action.action).max().unwrap_or(0));
        watch.resume(events.records());
        let (waits, timeline) = (Waits::new(&task), Timeline::new(&task));
        faults.resume(events.records());
        let (supervisor, snapshots) = (LogFollower::new(&report), SnapshotLog::open(&report, &task)?);
        let mut motion = JointMotion::new(limits, fresh);
        if let Ok(found) = coact_input_file::read_within(&report.join(MOTION), coact_input_file::LONGEST_TEXT)
        {
            let error =
                |cause| MonitorError::File { path: report.join(MOTION), cause: std::io::Error::other(cause) };
            motion.resume(serde_json::from_slice(&found).map_err(error)?);
        }
        if let Ok(found) =
            coact_input_file::read_within(&report.join(SEPARATION), coact_input_file::LONGEST_TEXT)
        {
            let error = |cause| MonitorError::File {
                path: report.join(SEPARATION),
                cause: std::io::Error::other(cause),
            };
            separation.resume(serde_json::from_slice(&found).map_err(error)?);
        }
        let (waiting, truth) = (VecDeque::new(), nothing_true_yet());
        Ok(Self {
            report,
            task,
            rules,
            start_ns,
            latencies,
            events,
            anticipation,
            watch,
            waits,
            timeline,
            faults,
            blindness: Blindness::default(),
            motion,
            separation,
            newest_command: None,
            commanding,
            commanded: 0,
            stop_requested: BTreeMap::new(),
            operators: Vec::new(),
            tracking: Tracking::new(),
            reaction: Reaction::new(),
            snapshots,
            supervisor,
            waiting,
            truth,
            refused: [0; Refusal::COUNT],
        })
    }

    /// Removes what the monitor of an earlier run left in a report directory; nothing else is touched.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub fn clear(report: &Path) -> Result<(), MonitorError> {
        let files = [Event::FILE, Snapshot::FILE, Summary::FILE].map(|name| report.join(name)).into_iter();
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
        let found = self.latencies.pulse(process, pulse);
        self.faults.pulse(process, pulse, found.outage);
        self.blindness.lost(pulse.header.cycle, found.unseen);
        let commands = self.commanding.as_deref() == Some(topic::stage(process));
        if commands && pulse.header.cycle > self.commanded {
            self.commanded = pulse.header.cycle;
            self.motion.commanded(pulse);
        }
    }

    /// The machine itself was late, whatever the processes did.
    pub fn machine_late(&mut self, late: LateWakeUp) {
        self.faults.machine_late(late);
    }

    /// What really happens; it is judged once the fields' frame of the same cycle has come, or is overdue.
    pub fn truth(&mut self, truth: &Truth, events: &mut Vec<Event>) {
        self.snapshots.truth(truth);
        if let Some(command) = &self.newest_command {
            self.separation.tick(truth, command);
            self.waits.tick(truth, command, events);
            let mut spans = Vec::new();
            self.timeline.tick(truth, command, &mut spans);
            events.extend(spans.into_iter().map(Event::Span));
        }
        self.waiting.push_back(*truth);
        self.catch_up(truth.header.cycle.saturating_sub(OVERDUE), events);
    }

    /// The fields; events are appended to `events`.
    pub fn frame(&mut self, frame: &FieldFrame, events: &mut Vec<Event>) {
        self.catch_up(frame.header.cycle, events);
        if frame.task == self.task.fingerprint {
            self.anticipation.frame(frame, events);
            self.watch.frame(frame, &self.truth, events);
        }
    }

    /// What the sensors said.
    pub fn sample(&mut self, sample: &SensorSample) {
        self.snapshots.sample(sample);
        self.motion.sample(sample);
    }

    /// What the joints' encoders said, of a sample that [`sample`](Self::sample) is not told of.
    pub fn joints(&mut self, sample: &SensorSample) {
        self.motion.sample(sample);
    }

    /// What the arm shall do.
    pub fn command(&mut self, command: &Command) {
        self.newest_command = Some(Box::new(*command));
        self.snapshots.command(command);
        self.tracking.command(command);
        self.reaction.command(command);
    }

    /// What the robot said.
    pub fn speech(&mut self, speech: &Speech, events: &mut Vec<Event>) {
        self.watch.speech(speech, events);
    }

    /// Reads what the supervisor wrote; before each look at the topics, so that a fault is known before the pulses that show
    /// how it went on.
    ///
    /// # Errors
    /// The supervisor's log cannot be read.
    pub fn read_supervisor(&mut self) -> Result<(), MonitorError> {
        for event in self.supervisor.news()? {
            self.faults.supervisor(&event);
            if event.event == SupervisorEventKind::StopRequested {
                self.stop_requested.insert(event.process, event.at_ns);
            } else if event.process == SupervisorEvent::OPERATOR {
                self.operators.push(event);
            }
        }
        Ok(())
    }

    /// So many messages the monitor's own ports have ignored so far.
    pub fn refused(&mut self, counts: [u32; Refusal::COUNT]) {
        self.refused = counts;
    }

    /// Reads what the supervisor wrote, settles faults, and writes events and snapshots; after each look at the topics.
    ///
    /// With a fault that is over the counters are written as well: a replacement of the monitor would count its outage again, as
    /// one of its own time.
    ///
    /// # Errors
    /// A file of the report cannot be read or written.
    pub fn record(&mut self, now_ns: u64, mut events: Vec<Event>) -> Result<(), MonitorError> {
        self.read_supervisor()?;
        events.extend(self.blindness.take());
        self.faults.settle(now_ns, &mut events);
        self.snapshots.look()?;
        if events.is_empty() {
            return Ok(());
        }
        let fault_is_over = events.iter().any(|event| matches!(event, Event::Fault(_)));
        self.events.append(events)?;
        if fault_is_over { self.write() } else { Ok(()) }
    }

    /// Writes intervals and counters; once a second.
    ///
    /// # Errors
    /// A file of the report cannot be written.
    pub fn write(&mut self) -> Result<(), MonitorError> {
        self.latencies.write()?;
        replace(&self.report.join(MOTION), &self.motion.report())
            .map_err(|cause| self.error(MOTION, cause))?;
        replace(&self.report.join(SEPARATION), self.separation.report())
            .map_err(|cause| self.error(SEPARATION, cause))
    }

    /// Ends the run: writes logs, plots and `summary.json`.
    ///
    /// # Errors
    /// A file of the report cannot be written.
    pub fn finish(mut self, environment: Environment, now_ns: u64) -> Result<Summary, MonitorError> {
        let mut events = Vec::new();
        self.catch_up(u64::MAX, &mut events);
        self.anticipation.finish(&mut events);
        self.waits.finish(&mut events);
        let mut spans = Vec::new();
        self.timeline.finish(self.truth.header.cycle, &mut spans);
        events.extend(spans.into_iter().map(Event::Span));
        self.record(now_ns, events)?;
        let mut open_faults = Vec::new();
        self.faults.finish(&mut open_faults);
        self.record(now_ns, open_faults)?;
        self.snapshots.finish()?;
        self.write()?;
        let summary = Findings {
            task: &self.task,
            environment,
            events: self.events.records(),
            metrics: Some(self.latencies.metrics()),
            stop_requested: &self.stop_requested,
            operator_stops: OperatorStopReport::all(&self.operators, self.start_ns),
            motion: self.motion.report(),
            separation: self.separation.report().clone(),
            blind_s: blind_s(self.events.records()),
            tracking: self.tracking.report(),
            reaction: self.reaction.report(),
            refused: self.refused,
            start_ns: self.start_ns,
            end_ns: now_ns,
            rules: &self.rules,
        }
        .summary();
        summary.write(&self.report)?;
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
        for (name, recorder) in self.latencies.metrics().histograms() {
            percentile_curve(&name.replace('.', " "), recorder, &folder.join(format!("{name}.svg")))?;
        }
        let spans: Vec<_> = self.events.records().iter().filter_map(Event::as_span).cloned().collect();
        gantt(&spans, &format!("{}: who did what", self.task.name), &folder.join("timeline.svg"))?;
        Ok(anticipation_timeline(&summary.anticipation.events, &folder.join("anticipation.svg"))?)
    }

    fn error(&self, file: &str, cause: std::io::Error) -> MonitorError {
        MonitorError::File { path: self.report.join(file), cause }
    }
}

fn nothing_true_yet() -> Truth {
    Truth { chain: NONE, subgoal: NONE, ..bytemuck::Zeroable::zeroed() }
}
