use crate::{Gaps, RecorderSettings};
use coact_messages::{Command, FieldFrame, Percept, Pulse, SensorSample, Speech, Truth, topic};
use coact_pipeline::{Pipeline, ProcessEntry, Trigger};
use coact_realtime::{Bus, Input, Message, PortError};
use coact_run_recording::Recorded;

/// All that the recorder listens to.
pub struct Topics {
    samples: Input<SensorSample>,
    percepts: Input<Percept>,
    frames: Input<FieldFrame>,
    commands: Input<Command>,
    speech: Input<Speech>,
    truth: Input<Truth>,
    pulses: Vec<Pulses>,
    frames_due: Due,
    commands_due: Due,
    truth_due: Due,
}

/// The pulses of one process.
struct Pulses {
    process: String,
    input: Input<Pulse>,
    /// Whether it alone sends its topic's messages. Of two that send in turn none has all sequences: nothing is missing there.
    is_alone: bool,
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
            let shares = |other: &ProcessEntry| other.standby_of.as_ref() == Some(&entry.name);
            let is_alone = entry.standby_of.is_none() && !pipeline.processes.iter().any(shares);
            let input = bus.input(&topic::pulse(&entry.name))?;
            pulses.push(Pulses { process: entry.name.clone(), input, is_alone });
        }
        Ok(Self {
            samples: bus.input(topic::SENSORS)?,
            percepts: bus.input(topic::PERCEPT)?,
            frames: bus.input(topic::FIELDS)?,
            commands: bus.input(topic::COMMAND)?,
            speech: bus.input(topic::SPEECH)?,
            truth: bus.input(topic::TRUTH)?,
            pulses,
            frames_due: Due { every: settings.frames_every, next: 0 },
            commands_due: Due { every: settings.commands_every, next: 0 },
            truth_due: Due { every: settings.truth_every, next: 0 },
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
        let Self {
            samples,
            percepts,
            frames,
            commands,
            speech,
            truth,
            pulses,
            frames_due,
            commands_due,
            truth_due,
        } = self;
        each(samples, gaps, keep, |sample| Recorded::Sample(Box::new(*sample)))?;
        each(percepts, gaps, keep, |percept| Recorded::Percept(Box::new(*percept)))?;
        for Pulses { process, input, is_alone } in pulses {
            let pulse = |pulse: &Pulse| Recorded::Pulse { process: process.clone(), pulse: Box::new(*pulse) };
            match is_alone {
                true => each(input, gaps, keep, pulse)?,
                false => some(input, |_| true, gaps, keep, pulse)?,
            }
        }
        each(speech, gaps, keep, |speech| Recorded::Speech(Box::new(*speech)))?;
        some(
            frames,
            |cycle| frames_due.is_due(cycle),
            gaps,
            keep,
            |frame| Recorded::Frame(Box::new(*frame)),
        )?;
        some(
            commands,
            |cycle| commands_due.is_due(cycle),
            gaps,
            keep,
            |command| Recorded::Command(Box::new(*command)),
        )?;
        some(truth, |cycle| truth_due.is_due(cycle), gaps, keep, |truth| Recorded::Truth(Box::new(*truth)))
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

/// The messages of the cycles that are due; nobody can tell what is missing between them.
fn some<T: Message>(
    input: &mut Input<T>,
    mut is_due: impl FnMut(u64) -> bool,
    gaps: &mut Gaps,
    keep: &mut impl FnMut(Recorded) -> bool,
    record: impl Fn(&T) -> Recorded,
) -> Result<(), PortError> {
    let topic = input.topic().to_owned();
    input.each(|message| {
        if is_due(message.header().cycle) && !keep(record(message)) {
            gaps.lose(&topic, 1);
        }
    })?;
    Ok(())
}
