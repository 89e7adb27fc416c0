//! The process around the neural-field network: a frame is integrated from the one before straight into shared memory.

use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Header, Percept, topic};
use coact_realtime::{Cycle, Input, Output, PortError, Process, Tick};

struct Fields {
    network: Network,
    percept: Input<Percept>,
    /// What the first frame is computed from: the network at rest, or the frame that a predecessor left.
    start: Box<FieldFrame>,
    previous: Input<FieldFrame>,
    frame: Output<FieldFrame>,
}

impl Cycle for Fields {
    type Trigger = Percept;

    fn trigger(&mut self) -> &mut Input<Percept> {
        &mut self.percept
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let Self { network, percept, start, previous, frame } = self;
        previous.refresh()?;
        let mut out = frame.loan()?;
        network.step(tick.cycle, percept.latest(), previous.latest().unwrap_or(start), &mut out);
        out.send(tick.cycle, percept.header().map_or(0, |header| header.sensor_ns))
    }
}

fn main() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("fields")?;
    let (task, plan) = NetworkPlan::load(&process.run().settings().task)?;
    let network = Network::new(plan, task.fingerprint, process.run().settings().seed)?;
    let percept = process.bus().trigger(topic::PERCEPT)?;
    let previous = process.bus().input(topic::FIELDS)?;
    let mut frame: Output<FieldFrame> = process.bus().output(topic::FIELDS)?;
    let start = match process.checkpoint(&mut frame)? {
        Some(last) if network.fits(&last) => last,
        Some(last) => {
            let cycle = last.header.cycle;
            tracing::warn!(
                "fields begins at rest: its checkpoint of cycle {cycle} is of another task or network"
            );
            at_rest(&network)
        }
        None => at_rest(&network),
    };
    Ok(process.run_cycles(Fields { network, percept, start, previous, frame })?)
}

fn at_rest(network: &Network) -> Box<FieldFrame> {
    let mut frame = bytemuck::zeroed_box();
    network.rest(&mut frame);
    frame
}
