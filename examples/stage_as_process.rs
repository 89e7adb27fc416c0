//! A stage of one's own as a process of a running set, in the same real-time shell as coact's own.
//!
//! Build it, and run it in a set whose process table is a copy of the shipped one with an entry more:
//!
//! ```text
//! cargo build --release -p coact-examples --example stage_as_process
//! cp rt-config/pipeline.toml rt-config/verdict.toml /tmp
//! cat >> /tmp/pipeline.toml <<END
//! [[process]]
//! name = "hand-speed"
//! program = "target/release/examples/stage_as_process"
//! order = 1
//! trigger = "coact/percept"
//! latest_start_us = 700
//! END
//! tools/launch --pipeline /tmp/pipeline.toml
//! ```
//!
//! The supervisor starts, watches and restarts it, and the report tells its latencies and missed deadlines, as those of all
//! others. With `realtime = true`, `priority` and `core` it is scheduled as they are.

use coact_examples::HandSpeed;
use coact_messages::{Header, Percept, topic};
use coact_realtime::{Cycle, Input, Output, PortError, Process, Tick};

/// The stage with its ports.
struct HandSpeedProcess {
    percept: Input<Percept>,
    speed: Output<HandSpeed>,
    previous: HandSpeed,
}

impl Cycle for HandSpeedProcess {
    /// A period's work begins when this message comes, or at the latest start that the process table names.
    type Trigger = Percept;

    fn trigger(&mut self) -> &mut Input<Percept> {
        &mut self.percept
    }

    /// Advances by one period. Nothing here allocates, blocks or reads a clock.
    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let Self { percept, speed, previous } = self;
        // The message is written where its readers will read it: in shared memory.
        let mut out = speed.loan()?;
        out.step(percept.latest(), previous);
        *previous = *out;
        // The output descends from the sensor sample that the input descends from: end to end is counted from there.
        out.send(tick.cycle, percept.header().map_or(0, |header| header.sensor_ns))
    }
}

fn main() -> anyhow::Result<()> {
    let process = Process::from_arguments("hand-speed")?;
    let percept = process.bus().trigger(topic::PERCEPT)?;
    let speed = process.bus().output(HandSpeed::TOPIC)?;
    Ok(process.run_cycles(HandSpeedProcess { percept, speed, previous: HandSpeed::default() })?)
}
