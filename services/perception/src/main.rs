//! The process around perception: each sensor sample becomes a percept.

use coact_joint_task::Task;
use coact_messages::{Header, Percept, SensorSample, topic};
use coact_perception::{Perception, PreshapeModel};
use coact_realtime::{Candidate, Cycle, Input, Output, PortError, Tick};
use coact_robot::Robot;

struct Observer {
    perception: Perception,
    sample: Input<SensorSample>,
    percept: Output<Percept>,
}

impl Cycle for Observer {
    type Trigger = SensorSample;

    fn trigger(&mut self) -> &mut Input<SensorSample> {
        &mut self.sample
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let Self { perception, sample, percept } = self;
        let mut out = percept.loan()?;
        perception.step(tick.cycle, sample.latest(), &mut out);
        out.send(tick.cycle, sample.header().map_or(0, |header| header.sensor_ns))
    }
}

fn main() -> anyhow::Result<()> {
    let candidate = Candidate::from_arguments("perception")?;
    let run = candidate.run().settings();
    let (task, robot) = (Task::load(&run.task)?, Robot::load(&run.robot)?);
    let mut perception = Perception::new(&task, &PreshapeModel::load(&run.model)?)?.with_robot(robot);
    let mut process = candidate.join()?;
    let sample = process.bus().trigger(topic::SENSORS)?;
    let mut percept = process.bus().output(topic::PERCEPT)?;
    if let Some(last) = process.checkpoint(&mut percept)?
        && let Err(refused) = perception.resume(&last)
    {
        tracing::warn!("perception begins anew: {refused}");
    }
    Ok(process.run_cycles(Observer { perception, sample, percept })?)
}
