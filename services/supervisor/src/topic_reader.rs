use crate::{ProcessSet, RunProgress};
use coact_messages::{FieldFrame, Pulse, Speech, topic};
use coact_pipeline::{Pipeline, Trigger};
use coact_realtime::{Bus, Input, PortError};

/// Reads what the supervisor needs of the run's topics: the newest field frame, what is said, every process's pulses.
pub(crate) struct TopicReader {
    frame: Input<FieldFrame>,
    speech: Input<Speech>,
    pulses: Vec<(String, Input<Pulse>)>,
    failed: bool,
}

impl TopicReader {
    /// Opens its topics.
    ///
    /// # Errors
    /// Shared memory refuses it.
    pub(crate) fn new(bus: &Bus, pipeline: &Pipeline) -> Result<Self, PortError> {
        let pulsing = pipeline.processes.iter().filter(|entry| entry.trigger != Trigger::None);
        let pulses = pulsing
            .map(|entry| Ok((entry.name.clone(), bus.input(&topic::pulse(&entry.name))?)))
            .collect::<Result<_, PortError>>()?;
        let (frame, speech) = (bus.input(topic::FIELDS)?, bus.input(topic::SPEECH)?);
        Ok(Self { frame, speech, pulses, failed: false })
    }

    /// Tells `set` who published a pulse, and `progress` what has changed.
    pub(crate) fn poll(&mut self, set: &mut ProcessSet, progress: &mut RunProgress) {
        if let (Err(error), false) = (self.read(set, progress), self.failed) {
            self.failed = true;
            tracing::warn!("the progress shown is incomplete: {error}");
        }
    }

    fn read(&mut self, set: &mut ProcessSet, progress: &mut RunProgress) -> Result<(), PortError> {
        let mut outcome = Ok(());
        for (process, input) in &mut self.pulses {
            match input.refresh() {
                Ok(true) => {
                    set.pulse(process);
                    input.latest().into_iter().for_each(|pulse| progress.pulse(process, pulse));
                }
                Ok(false) => {}
                // What the supervisor itself cannot read says nothing about the process: it does not hang for that.
                Err(error) => {
                    set.pulse(process);
                    outcome = Err(error);
                }
            }
        }
        if self.frame.refresh()?
            && let Some(frame) = self.frame.latest()
        {
            progress.frame(frame);
        }
        self.speech.each(|speech| progress.speech(speech))?;
        outcome
    }
}
