//! The process that stands in for the hardware: released by the timer, it starts each cycle of the chain.

use coact_joint_task::Task;
use coact_messages::{Command, Header, SensorSample, Truth, WorldState, topic};
use coact_pipeline::{RunSettings, WorldMode};
use coact_realtime::{Cycle, Input, Output, PortError, Process, Tick, now};
use coact_robot::Robot;
use coact_world::{BodyKind, Partner, Settings, World};

struct Hardware {
    world: World,
    command: Input<Command>,
    sample: Output<SensorSample>,
    truth: Output<Truth>,
    state: Output<WorldState>,
}

impl Cycle for Hardware {
    type Trigger = Command;

    fn trigger(&mut self) -> &mut Input<Command> {
        &mut self.command
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let Self { world, command, sample, truth, state } = self;
        let (mut sample, mut truth, mut state) = (sample.loan()?, truth.loan()?, state.loan()?);
        world.step(tick.cycle, command.latest(), &mut sample, &mut truth, &mut state);
        // The sensors are read now. What the simulation of the bodies before them cost is no part of a real robot.
        let sensor_ns = now();
        let header = sample.send(tick.cycle, sensor_ns)?;
        truth.send(tick.cycle, sensor_ns)?;
        state.send(tick.cycle, sensor_ns)?;
        Ok(header)
    }
}

fn main() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("world")?;
    let mut world = world(process.run().settings())?;
    let command = process.bus().input(topic::COMMAND)?;
    let mut sample: Output<SensorSample> = process.bus().output(topic::SENSORS)?;
    let mut truth: Output<Truth> = process.bus().output(topic::TRUTH)?;
    let mut state: Output<WorldState> = process.bus().output(topic::WORLD_STATE)?;
    if let Some(last) = process.survivor(&mut state)? {
        world.resume(&last);
        sample.continue_after(&last.header);
        truth.continue_after(&last.header);
    }
    Ok(process.run_cycles(Hardware { world, command, sample, truth, state })?)
}

fn world(run: &RunSettings) -> anyhow::Result<World> {
    let task = Task::load(&run.task)?;
    let robot = Robot::load(&run.robot)?;
    let body = match run.world {
        WorldMode::Physics => BodyKind::Physics,
        WorldMode::Kinematic => BodyKind::Kinematic,
    };
    let settings = Settings { seed: run.seed, partner: Partner::load(&run.partner, &task, run.seed)?, body };
    Ok(World::new(&task, &robot, settings)?)
}
