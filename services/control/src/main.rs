//! The process around control: each field frame becomes a command to the joints.

use coact_control::Control;
use coact_joint_task::Task;
use coact_messages::{Command, FieldFrame, Header, Percept, SensorSample, topic};
use coact_realtime::{
    BackgroundThread, Candidate, Cycle, Input, PortError, StandIn, Tick, end_for_hung_thread,
};
use coact_robot::Robot;
use coact_safety::SafetyLimits;

struct ControlCycle {
    control: Control,
    /// The thread that plans for it.
    planner: BackgroundThread,
    sample: Input<SensorSample>,
    percept: Input<Percept>,
    frame: Input<FieldFrame>,
    command: StandIn<Command>,
    /// Header of the command that this process sent, or was resumed from.
    last: Option<Header>,
}

impl Cycle for ControlCycle {
    type Trigger = FieldFrame;

    fn trigger(&mut self) -> &mut Input<FieldFrame> {
        &mut self.frame
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let Self { control, sample, percept, frame, command, last, .. } = self;
        if let Some(sent) = command.sent_by_other(tick)? {
            return Ok(sent);
        }
        sample.refresh()?;
        percept.refresh()?;
        let (newest, mut out) = command.prepare()?;
        // The stage goes on from the command that it sent itself, or was resumed from, unless its standby has sent since.
        let previous = newest.filter(|newest| Some(newest.header) != *last);
        control.step(tick.cycle, sample.latest(), percept.latest(), frame.latest(), previous, &mut out);
        let header = out.send(tick.cycle, frame.header().map_or(0, |header| header.sensor_ns))?;
        *last = Some(header);
        if self.control.planner_hangs(|since| self.planner.starves(since)) {
            end_for_hung_thread("planner");
        }
        Ok(header)
    }
}

fn main() -> anyhow::Result<()> {
    let candidate = Candidate::from_arguments("control")?;
    let run = candidate.run().settings();
    let (task, robot) = (Task::load(&run.task)?, Robot::load(&run.robot)?);
    let limits = SafetyLimits::load(&run.safety)?;
    let (mut control, planner) = match candidate.generation() {
        0 => Control::in_real_time(robot, &task, &limits)?,
        _ => Control::of_replacement(robot, &task, &limits)?,
    };
    let mut process = candidate.join()?;
    let sample = process.bus().input(topic::SENSORS)?;
    let percept = process.bus().input(topic::PERCEPT)?;
    let frame = process.bus().trigger(topic::FIELDS)?;
    let mut command: StandIn<Command> = process.stand_in(topic::COMMAND)?;
    let checkpoint = process.checkpoint(command.output())?;
    let last = checkpoint.as_ref().map(|last| last.header);
    if let Some(last) = checkpoint {
        let cycle = last.header.cycle;
        if !control.resume(&last) {
            tracing::warn!("control begins at rest: the state in its checkpoint of cycle {cycle} is damaged");
        }
    }
    let freezes = process.background_freezes();
    let planner = process.spawn_background("planner", move || planner.run(&freezes))?;
    Ok(process.run_cycles(ControlCycle { control, planner, sample, percept, frame, command, last })?)
}
