//! The process around the neural-field network: a frame is integrated from the one before straight into shared memory.

use coact_fields::Network;
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Header, Percept, topic};
use coact_realtime::{Candidate, Cycle, Input, PortError, StandIn, Tick};

struct Fields {
    network: Network,
    percept: Input<Percept>,
    /// What the first frame is computed from: the network at rest, or the frame that a predecessor left.
    start: Box<FieldFrame>,
    frame: StandIn<FieldFrame>,
}

impl Cycle for Fields {
    type Trigger = Percept;

    fn trigger(&mut self) -> &mut Input<Percept> {
        &mut self.percept
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let Self { network, percept, start, frame } = self;
        if let Some(sent) = frame.sent_by_other(tick)? {
            return Ok(sent);
        }
        let (previous, mut out) = frame.prepare()?;
        network.step(tick.cycle, percept.latest(), previous.unwrap_or(start), &mut out);
        out.send(tick.cycle, percept.header().map_or(0, |header| header.sensor_ns))
    }
}

fn main() -> anyhow::Result<()> {
    let candidate = Candidate::from_arguments("fields")?;
    let (task, plan) = NetworkPlan::load(&candidate.run().settings().task)?;
    let network = Network::new(plan, task.fingerprint, candidate.run().settings().seed)?;
    let mut process = candidate.join()?;
    let percept = process.bus().trigger(topic::PERCEPT)?;
    let mut frame: StandIn<FieldFrame> = process.stand_in(topic::FIELDS)?;
    let start = match process.checkpoint(frame.output())? {
        Some(last) if network.fits(&last) && last.is_whole() => last,
        Some(last) => {
            let cycle = last.header.cycle;
            tracing::warn!(
                "fields begins at rest: its checkpoint of cycle {cycle} is damaged, or of another task or network"
            );
            at_rest(&network)
        }
        None => at_rest(&network),
    };
    Ok(process.run_cycles(Fields { network, percept, start, frame })?)
}

fn at_rest(network: &Network) -> Box<FieldFrame> {
    let mut frame = bytemuck::zeroed_box();
    network.rest(&mut frame);
    frame
}
