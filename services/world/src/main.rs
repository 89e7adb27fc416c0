//! The process that stands in for the hardware: released by the timer, it starts each cycle of the chain.

mod outside_input;
mod stop_input;

use anyhow::Context;
use coact_joint_task::Task;
use coact_messages::{
    Command, HandPoints, Header, HoldReason, SensorSample, Speech, Truth, WorldState, topic,
};
use coact_pipeline::RunSettings;
use coact_realtime::{Candidate, Cycle, DropOuts, Input, Output, PortError, Tick, now};
use coact_recordings::{Order, read_folder};
use coact_robot::Robot;
use coact_safety::{DriveLimits, SafetyLimits};
use coact_world::{Partner, Replay, Settings, World, has_part_for, laid_out};
use outside_input::OutsideInput;
use std::path::Path;
use stop_input::StopInput;

/// What `RunSettings::partner` begins with when recorded reaches are to be played.
const REPLAY: &str = "replay:";

/// The simulated world.
struct Hardware {
    world: World,
    command: Input<Command>,
    sample: Output<SensorSample>,
    truth: Output<Truth>,
    state: Output<WorldState>,
    heard: OutsideInput<Speech>,
    /// The person's hand, if it comes from outside.
    hand: Option<OutsideInput<HandPoints>>,
    stop: StopInput,
    drop_outs: DropOuts,
    /// The process is told to end.
    ends: bool,
    /// Actions of the script of which it is known that they could not be done.
    skipped: u64,
}

impl Cycle for Hardware {
    type Trigger = Command;

    fn trigger(&mut self) -> &mut Input<Command> {
        &mut self.command
    }

    fn may_end(&mut self) -> bool {
        self.ends = true;
        self.world.stands()
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let hold = match (self.ends, self.stop.stops(tick.cycle)?) {
            (true, _) => HoldReason::Ending,
            (false, true) => HoldReason::Stopped,
            (false, false) => HoldReason::None,
        };
        self.world.hold(hold);
        if let Some(time) = self.drop_outs.take() {
            self.world.drop_out(time);
        }
        if let Some(speech) = self.heard.next() {
            self.world.hear(speech.sentence());
        }
        if let Some(hand) = self.hand.as_ref().and_then(OutsideInput::newest) {
            self.world.show_hand(&hand.position);
        }
        let Self { world, command, sample, truth, state, .. } = self;
        let (mut sample, mut truth, mut state) = (sample.loan()?, truth.loan()?, state.loan()?);
        world.step(tick.cycle, command.latest(), &mut sample, &mut truth, &mut state);
        let simulated_ns = now();
        truth.send(tick.cycle, simulated_ns)?;
        state.send(tick.cycle, simulated_ns)?;
        // The sensors are read now. What the simulation of the bodies before them cost is no part of a real robot. They are sent
        // last: perception waits for them, on this core.
        let header = sample.send(tick.cycle, now())?;
        if self.world.skipped() > self.skipped {
            self.skipped = self.world.skipped();
            tracing::warn!("the script's next action was left out: no part for it came within reach");
        }
        Ok(header)
    }
}

/// Recorded reaches in its place.
struct Recording {
    replay: Replay,
    /// Nobody carries it out.
    command: Input<Command>,
    sample: Output<SensorSample>,
    truth: Output<Truth>,
}

impl Cycle for Recording {
    type Trigger = Command;

    fn trigger(&mut self) -> &mut Input<Command> {
        &mut self.command
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let (mut sample, mut truth) = (self.sample.loan()?, self.truth.loan()?);
        self.replay.step(tick.cycle, &mut sample, &mut truth);
        truth.send(tick.cycle, now())?;
        sample.send(tick.cycle, now())
    }
}

fn main() -> anyhow::Result<()> {
    let candidate = Candidate::from_arguments("world")?;
    match candidate.run().settings().partner.strip_prefix(REPLAY).map(str::to_owned) {
        Some(recording) => play(candidate, &recording),
        None => simulate(candidate),
    }
}

/// Plays the reaches of one person; `recording` is `PARTICIPANT:DIR`.
fn play(candidate: Candidate, recording: &str) -> anyhow::Result<()> {
    let run = candidate.run().settings();
    let (task, robot) = (Task::load(&run.task)?, Robot::load(&run.robot)?);
    let (participant, folder) = recording
        .split_once(':')
        .and_then(|(participant, folder)| Some((participant.parse::<u32>().ok()?, Path::new(folder))))
        .with_context(|| format!("partner {REPLAY}{recording}: expected {REPLAY}PARTICIPANT:DIR"))?;
    let reaches = read_folder(folder)?;
    let people = Order::Trial { seed: run.seed }.people(&reaches);
    let person = people
        .iter()
        .find(|person| person[0].participant == participant)
        .with_context(|| format!("{}: no reach of participant {participant}", folder.display()))?;
    let replay = Replay::new(&task, &robot, person, |reach| has_part_for(&task, reach));
    let process = candidate.join()?;
    let command = process.bus().input(topic::COMMAND)?;
    let (sample, truth) = (process.bus().output(topic::SENSORS)?, process.bus().output(topic::TRUTH)?);
    Ok(process.run_cycles(Recording { replay, command, sample, truth })?)
}

fn simulate(candidate: Candidate) -> anyhow::Result<()> {
    let drive = SafetyLimits::load(&candidate.run().settings().safety)?.drive;
    let mut world = world(candidate.run().settings(), drive)?;
    let mut process = candidate.join()?;
    process.outlive_supervisor()?;
    let stop = StopInput::open(process.bus(), drive.stop_unheard_after)?;
    let command = process.bus().input(topic::COMMAND)?;
    let mut sample: Output<SensorSample> = process.bus().output(topic::SENSORS)?;
    let mut truth: Output<Truth> = process.bus().output(topic::TRUTH)?;
    let mut state: Output<WorldState> = process.bus().output(topic::WORLD_STATE)?;
    if let Some(last) = process.checkpoint(&mut state)? {
        if let Err(reason) = world.resume(&last) {
            tracing::warn!("the world starts anew: {reason}");
        }
        sample.continue_after(&last.header);
        truth.continue_after(&last.header);
    }
    let (run, refusals) = (process.run(), process.bus().refusals());
    let heard = OutsideInput::speech(run, refusals.clone())?;
    let from_outside = run.settings().partner == Partner::HAND;
    let hand = from_outside.then(|| OutsideInput::hand(run, refusals.clone())).transpose()?;
    let skipped = world.skipped();
    let (drop_outs, ends) = (process.drop_outs(), false);
    Ok(process.run_cycles(Hardware {
        world,
        command,
        sample,
        truth,
        state,
        heard,
        hand,
        stop,
        drop_outs,
        ends,
        skipped,
    })?)
}

fn world(run: &RunSettings, drive: DriveLimits) -> anyhow::Result<World> {
    let task = Task::load(&run.task)?;
    let robot = Robot::load(&run.robot)?;
    let settings = Settings::of_run(run, &task, drive)?;
    Ok(World::new(&laid_out(&task, run.layout)?, &robot, settings)?)
}
