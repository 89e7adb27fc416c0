use crate::{Machine, Seen};
use coact_messages::{Command, FieldFrame, Percept, SensorSample, Truth, topic};
use coact_monitor::PulseInputs;
use coact_pipeline::{Pipeline, Trigger};
use coact_realtime::{Bus, Input, PortError};

/// All that the console listens to while a run goes on.
pub struct LiveTopics {
    samples: Input<SensorSample>,
    percepts: Input<Percept>,
    frames: Input<FieldFrame>,
    commands: Input<Command>,
    truth: Input<Truth>,
    pulses: PulseInputs,
}

impl LiveTopics {
    /// Opens them: also the pulses of all processes of the table that have cycles.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn open(bus: &Bus, pipeline: &Pipeline) -> Result<Self, PortError> {
        let with_cycles = pipeline.processes.iter().filter(|entry| entry.trigger != Trigger::None);
        Ok(Self {
            samples: bus.input(topic::SENSORS)?,
            percepts: bus.input(topic::PERCEPT)?,
            frames: bus.input(topic::FIELDS)?,
            commands: bus.input(topic::COMMAND)?,
            truth: bus.input(topic::TRUTH)?,
            pulses: PulseInputs::open(bus, with_cycles.map(|entry| entry.name.clone()))?,
        })
    }

    /// Takes in the newest message of each, and all pulses.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn refresh(&mut self, machine: &mut Machine) -> Result<(), PortError> {
        self.samples.refresh()?;
        self.percepts.refresh()?;
        self.frames.refresh()?;
        self.commands.refresh()?;
        self.truth.refresh()?;
        self.pulses.each(|process, pulse| machine.pulse(process, pulse))
    }

    /// The newest messages.
    pub fn seen(&self) -> Seen<'_> {
        Seen {
            sample: self.samples.latest(),
            percept: self.percepts.latest(),
            frame: self.frames.latest(),
            command: self.commands.latest(),
            truth: self.truth.latest(),
        }
    }
}
