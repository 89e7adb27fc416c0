use crate::{Gaps, RecorderSettings};
use coact_messages::{Command, FieldFrame, Percept, Pulse, SensorSample, Speech, topic};
use coact_pipeline::{Pipeline, Trigger};
use coact_realtime::{Bus, Input, Message, PortError};
use coact_run_recording::Recorded;

/// All that the recorder listens to.
pub struct Topics {
    samples: Input<SensorSample>,
    percepts: Input<Percept>,
    frames: Input<FieldFrame>,
    commands: Input<Command>,
    speech: Input<Speech>,
    pulses: Vec<(String, Input<Pulse>)>,
    frames_due: Due,
    commands_due: Due,
}

/// Keeps one message in so many cycles.
struct Due {
    every: u64,
    next: u64,
}

impl Due {
    fn is_due(&mut self, cycle: u64) -> bool {
        let is_due = cycle >= self.next;
        if is_due {
            self.next = (cycle / self.every + 1) * self.every;
        }
        is_due
    }
}

impl Topics {
    /// Opens them: also the pulses of all processes of the table that have cycles.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn open(bus: &Bus, pipeline: &Pipeline, settings: RecorderSettings) -> Result<Self, PortError> {
        let mut pulses = Vec::new();
        for entry in pipeline.processes.iter().filter(|entry| entry.trigger != Trigger::None) {
            pulses.push((entry.name.clone(), bus.input(&topic::pulse(&entry.name))?));
        }
        Ok(Self {
            samples: bus.input(topic::SENSORS)?,
            percepts: bus.input(topic::PERCEPT)?,
            frames: bus.input(topic::FIELDS)?,
            commands: bus.input(topic::COMMAND)?,
            speech: bus.input(topic::SPEECH)?,
            pulses,
            frames_due: Due { every: settings.frames_every, next: 0 },
            commands_due: Due { every: settings.commands_every, next: 0 },
        })
    }

    /// Takes in what has come since the last look, and hands it to `keep`, which says whether there was room for it. What was
    /// missing or found no room is counted in `gaps`.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn drain(
        &mut self,
        gaps: &mut Gaps,
        keep: &mut impl FnMut(Recorded) -> bool,
    ) -> Result<(), PortError> {
        let Self { samples, percepts, frames, commands, speech, pulses, frames_due, commands_due } = self;
        each(samples, gaps, keep, |sample| Recorded::Sample(Box::new(*sample)))?;
        each(percepts, gaps, keep, |percept| Recorded::Percept(Box::new(*percept)))?;
        for (process, input) in pulses {
            let pulse = |pulse: &Pulse| Recorded::Pulse { process: process.clone(), pulse: Box::new(*pulse) };
            each(input, gaps, keep, pulse)?;
        }
        each(speech, gaps, keep, |speech| Recorded::Speech(Box::new(*speech)))?;
        some(frames, frames_due, gaps, keep, |frame| Recorded::Frame(Box::new(*frame)))?;
        some(commands, commands_due, gaps, keep, |command| Recorded::Command(Box::new(*command)))
    }
}

/// Every message.
fn each<T: Message>(
    input: &mut Input<T>,
    gaps: &mut Gaps,
    keep: &mut impl FnMut(Recorded) -> bool,
    record: impl Fn(&T) -> Recorded,
) -> Result<(), PortError> {
    let topic = input.topic().to_owned();
    input.each(|message| {
        gaps.heard(&topic, message.header());
        if !keep(record(message)) {
            gaps.lose(&topic, 1);
        }
    })?;
    Ok(())
}

/// The messages that are due.
fn some<T: Message>(
    input: &mut Input<T>,
    due: &mut Due,
    gaps: &mut Gaps,
    keep: &mut impl FnMut(Recorded) -> bool,
    record: impl Fn(&T) -> Recorded,
) -> Result<(), PortError> {
    let topic = input.topic().to_owned();
    input.each(|message| {
        if due.is_due(message.header().cycle) && !keep(record(message)) {
            gaps.lose(&topic, 1);
        }
    })?;
    Ok(())
}
