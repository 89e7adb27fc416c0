use crate::fields_replay::FieldsReplay;
use crate::in_order::InOrder;
use crate::kept::Kept;
use crate::perception_replay::PerceptionReplay;
use crate::stage_replay::{Input, StageReplay};
use crate::stages::Stages;
use crate::{ReplayError, ReplayReport};
use coact_messages::{FieldFrame, Header, Percept, Pulse, SensorSample, topic};
use coact_realtime::Message;
use coact_run_recording::{Recorded, Recording};
use std::path::Path;

/// Computes a recorded run again, and compares.
///
/// # Errors
/// The recording cannot be read, or holds nothing that can be compared.
pub fn replay(path: &Path) -> Result<ReplayReport, ReplayError> {
    let mut recording = Recording::open(path)?;
    let mut replay = Replay::of(Stages::of(recording.origin())?);
    let mut messages = InOrder::default();
    loop {
        let read = recording.next_message()?;
        let more_may_come = read.is_some();
        if let Some(message) = read {
            messages.put(message);
        }
        while let Some(message) = messages.next(more_may_come) {
            replay.message(message);
        }
        if !more_may_come {
            break;
        }
    }
    let report = replay.report(&recording, path);
    match report.percepts.compared + report.frames.compared {
        0 => Err(ReplayError::Nothing { path: path.to_owned() }),
        _ => Ok(report),
    }
}

/// A run that is computed again, message by message, in the order in which they were published.
struct Replay {
    perception: StageReplay<PerceptionReplay>,
    fields: StageReplay<FieldsReplay>,
    samples: Kept<SensorSample>,
    percepts: Kept<Percept>,
    cycles: Option<(u64, u64)>,
    decisions: u64,
    decided: Option<u32>,
}

impl Replay {
    fn of(stages: Stages) -> Self {
        Self {
            perception: StageReplay::new(PerceptionReplay::new(stages.perception), topic::PERCEPT),
            fields: StageReplay::new(FieldsReplay::new(stages.network), topic::FIELDS),
            samples: Kept::default(),
            percepts: Kept::default(),
            cycles: None,
            decisions: 0,
            decided: None,
        }
    }

    fn message(&mut self, message: Recorded) {
        match message {
            Recorded::Sample(sample) => self.sample(sample),
            Recorded::Pulse { process, pulse } => match topic::stage(&process) {
                "perception" => self.perceived(&pulse.header, Some(&pulse)),
                "fields" => self.integrated(&pulse.header, Some(&pulse)),
                _ => {}
            },
            Recorded::Percept(percept) => self.percept(&percept),
            Recorded::Frame(frame) => self.frame(&frame),
            Recorded::Command(_) | Recorded::Speech(_) | Recorded::Truth(_) => {}
        }
    }

    fn sample(&mut self, sample: Box<SensorSample>) {
        let Header { cycle, published_ns, .. } = sample.header;
        self.cycles = Some(self.cycles.map_or((cycle, cycle), |(first, last)| (first, last.max(cycle))));
        self.samples.keep(published_ns, sample);
    }

    /// Perception has sent a percept: its pulse says on what, or, where that is lost, its own header.
    fn perceived(&mut self, header: &Header, pulse: Option<&Pulse>) {
        if !self.perception.is_news(header) {
            return;
        }
        let input = input_of(&self.samples, header, pulse);
        self.perception.compute(header, input);
        if let Some(percept) = self.perception.newest() {
            self.percepts.keep(header.published_ns, Box::new(*percept));
        }
    }

    fn percept(&mut self, recorded: &Percept) {
        self.perceived(&recorded.header, None);
        self.perception.compare(recorded);
        // Where nothing was computed, what was recorded is what fields were given.
        let published_ns = recorded.header.published_ns;
        if self.percepts.published_at(published_ns).is_none() {
            self.percepts.keep(published_ns, Box::new(*recorded));
        }
    }

    /// The same of fields.
    fn integrated(&mut self, header: &Header, pulse: Option<&Pulse>) {
        if !self.fields.is_news(header) {
            return;
        }
        let input = input_of(&self.percepts, header, pulse);
        self.fields.compute(header, input);
    }

    fn frame(&mut self, recorded: &FieldFrame) {
        self.integrated(&recorded.header, None);
        let before = self.fields.report.compared;
        self.fields.compare(recorded);
        let decided = recorded.decision.action;
        if self.fields.report.compared > before && self.decided.replace(decided) != Some(decided) {
            self.decisions += u64::from(decided != coact_messages::NONE);
        }
    }

    fn report(self, recording: &Recording, path: &Path) -> ReplayReport {
        let origin = recording.origin();
        let (percepts, frames) = (self.perception.report, self.fields.report);
        ReplayReport {
            recording: path.to_owned(),
            equal: percepts.differing + frames.differing == 0,
            same_code: origin.is_of_this_code(),
            version: origin.version.clone(),
            truncated: recording.is_truncated(),
            lost: recording.lost().cloned(),
            cycles: self.cycles,
            percepts,
            frames,
            decisions: self.decisions,
        }
    }
}

/// What the output with this header was computed on. Its pulse says so; where that is lost, or is of the other instance of a stage
/// that has a standby and tells of an input of its own, the sample that the output descends from does.
fn input_of<'a, T: Message>(kept: &'a Kept<T>, header: &Header, pulse: Option<&Pulse>) -> Input<'a, T> {
    let descends = |input: &T| input.header().sensor_ns == header.sensor_ns;
    if header.sensor_ns == 0 && pulse.is_some_and(|pulse| pulse.input_published_ns == 0) {
        return Input::Known(None);
    }
    let told = pulse.and_then(|pulse| kept.published_at(pulse.input_published_ns));
    match told.filter(|input| descends(input)).or_else(|| kept.newest(descends)) {
        None if header.sensor_ns != 0 => Input::Lost,
        input => Input::Known(input),
    }
}
