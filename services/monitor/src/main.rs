//! The monitor as a process: drains all topics that tell how the run goes, and writes its report.

use anyhow::Context;
use coact_joint_task::NetworkPlan;
use coact_messages::{ARM_JOINTS, Command, FieldFrame, SensorSample, Speech, Truth, topic};
use coact_monitor::{
    Intentions, Monitor, MonitorError, PipelineNode, PulseInputs, Rules, Watched, environment,
};
use coact_realtime::{Bus, Input, LatencyProbe, PortError, Process, Schedule, handles_left, now};
use coact_robot::Robot;
use coact_run_records::Environment;
use coact_safety::SafetyLimits;
use coact_separation::SeparationMeter;
use std::time::{Duration, Instant, SystemTime};

/// How often the topics are drained: long before a reader's buffer is full, and seldom enough to cost little of a core.
const LOOK_EVERY: Duration = Duration::from_millis(5);
/// How often histograms go to disk: a kill loses no more than that.
const WRITE_EVERY: Duration = Duration::from_secs(1);

fn main() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("monitor")?;
    let watched = watched(&process)?;
    let names = watched.nodes.iter().map(|node| node.process.clone()).collect();
    if process.generation() == 0 {
        Monitor::clear(&watched.report)?;
    }
    let mut topics = Topics::open(process.bus(), names)?;
    process.report_ready()?;
    let Some(schedule) = process.wait_for_start()? else { return Ok(()) };
    let probe = LatencyProbe::start(process.pipeline(), schedule);
    let mut monitor = Monitor::open(since_start(watched, schedule))?;
    let mut written = Instant::now();
    let mut refused = None;
    let mut heartbeat = process.heartbeat()?;
    while !process.stop_requested() {
        heartbeat.beat()?;
        std::thread::sleep(LOOK_EVERY);
        probe.iter().flat_map(LatencyProbe::take_late).for_each(|late| monitor.machine_late(late));
        topics.drain(&mut monitor, &mut refused)?;
        process.warn_of_refusals();
        if written.elapsed() >= WRITE_EVERY {
            written = Instant::now();
            warn_once(monitor.write(), &mut refused)?;
        }
    }
    topics.drain(&mut monitor, &mut refused)?;
    monitor.refused(process.bus().refusals().counts());
    let machine = probe.map(|probe| environment::of_probe(&probe.lateness()));
    let environment = Environment { machine, ..environment::of_run(process.run(), process.pipeline()) };
    monitor.finish(environment, now())?;
    Ok(())
}

fn watched(process: &Process) -> anyhow::Result<Watched> {
    let settings = process.run().settings();
    let (task, plan) = NetworkPlan::load(&settings.task)?;
    let folder = settings.pipeline.parent().context("the process table stands in no folder")?;
    let robot = Robot::load(&settings.robot)?;
    let limits = SafetyLimits::load(&settings.safety)?;
    Ok(Watched {
        report: settings.report.clone(),
        task,
        intentions: Intentions::from(&plan),
        nodes: PipelineNode::all(process.pipeline()),
        limits: robot.limits()[..ARM_JOINTS].to_vec(),
        separation: SeparationMeter::new(&robot, &limits)?,
        fresh: limits.stale.input_after,
        rules: Rules::load(&folder.join(Rules::FILE))?,
        start_ns: 0,
        started: SystemTime::UNIX_EPOCH,
    })
}

/// The start of the run by both clocks.
fn since_start(watched: Watched, schedule: Schedule) -> Watched {
    let elapsed = Duration::from_nanos(now().saturating_sub(schedule.start_ns));
    Watched { start_ns: schedule.start_ns, started: SystemTime::now() - elapsed, ..watched }
}

/// A full disk must not end the run: the first failure is warned of, later ones are not. For want of handles the monitor ends: its
/// replacement has some.
fn warn_once(result: Result<(), MonitorError>, refused: &mut Option<MonitorError>) -> anyhow::Result<()> {
    let Err(error) = result else { return Ok(()) };
    handles_left().with_context(|| error.to_string())?;
    if refused.is_none() {
        tracing::warn!("{error}; the report lacks what could not be written");
        *refused = Some(error);
    }
    Ok(())
}

/// All that the monitor listens to.
struct Topics {
    pulses: PulseInputs,
    truth: Input<Truth>,
    sensors: Input<SensorSample>,
    fields: Input<FieldFrame>,
    command: Input<Command>,
    speech: Input<Speech>,
}

impl Topics {
    fn open(bus: &Bus, processes: Vec<String>) -> Result<Self, PortError> {
        let (truth, fields) = (bus.input(topic::TRUTH)?, bus.input(topic::FIELDS)?);
        Ok(Self {
            pulses: PulseInputs::open(bus, processes)?,
            truth,
            sensors: bus.input(topic::SENSORS)?,
            fields,
            command: bus.input(topic::COMMAND)?,
            speech: bus.input(topic::SPEECH)?,
        })
    }

    fn drain(&mut self, monitor: &mut Monitor, refused: &mut Option<MonitorError>) -> anyhow::Result<()> {
        let Self { pulses, truth, sensors, fields, command, speech } = self;
        let mut events = Vec::new();
        warn_once(monitor.read_supervisor(), refused)?;
        pulses.each(|process, pulse| monitor.pulse(process, pulse))?;
        truth.each(|truth| monitor.truth(truth, &mut events))?;
        sensors.each(|sample| monitor.sample(sample))?;
        fields.each(|frame| monitor.frame(frame, &mut events))?;
        command.each(|command| monitor.command(command))?;
        speech.each(|speech| monitor.speech(speech, &mut events))?;
        warn_once(monitor.record(now(), events), refused)
    }
}
