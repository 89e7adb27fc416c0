use crate::{Difference, StageReport};
use bytemuck::bytes_of;
use coact_messages::{Described, Description, Header};
use coact_realtime::Message;

/// A stage as the replay sees it: it computes an output from an input, and goes on from any of its outputs.
pub(crate) trait Stage {
    type Input: Message;
    type Output: Message + Described;

    /// Forgets everything: as after a start without a checkpoint.
    fn begin_anew(&mut self);
    /// Goes on from this message: as a replacement.
    fn resume(&mut self, last: &Self::Output);
    /// Computes the message of a cycle; its header is not written.
    fn step(&mut self, cycle: u64, input: Option<&Self::Input>, out: &mut Self::Output);
}

/// How an output was computed.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Input<'a, T> {
    /// On this, or on nothing.
    Known(Option<&'a T>),
    /// On something that is not in the recording.
    Lost,
}

/// Replays one stage: computes each of its outputs on what it was computed on, and compares those that were recorded.
pub(crate) struct StageReplay<S: Stage> {
    stage: S,
    topic: &'static str,
    description: Description,
    /// The newest output, with the header that it had; its state is the stage's, if that is known.
    newest: Box<S::Output>,
    has_newest: bool,
    knows_state: bool,
    /// The newest output has been compared, or was resumed from.
    is_judged: bool,
    pub report: StageReport,
}

impl<S: Stage> StageReplay<S> {
    pub fn new(stage: S, topic: &'static str) -> Self {
        Self {
            stage,
            topic,
            description: S::Output::description(),
            newest: bytemuck::zeroed_box(),
            has_newest: false,
            knows_state: false,
            is_judged: false,
            report: StageReport::default(),
        }
    }

    /// The newest output that was computed, if its bits are known.
    pub fn newest(&self) -> Option<&S::Output> {
        (self.has_newest && self.knows_state).then_some(&*self.newest)
    }

    /// Whether the output with this header is one that is not known yet.
    pub fn is_news(&self, header: &Header) -> bool {
        let newest = self.newest.header();
        !self.has_newest || (header.cycle > newest.cycle && header.sequence != newest.sequence)
    }

    /// The stage has sent a message with this header, computed on this input: computes it again. `header.sensor_ns` is the
    /// stage's word; the one that is computed is the input's.
    pub fn compute(&mut self, header: &Header, input: Input<'_, S::Input>) {
        self.follow(header);
        let Input::Known(input) = input else {
            self.knows_state = false;
            return;
        };
        if !self.knows_state {
            return;
        }
        self.stage.step(header.cycle, input, &mut self.newest);
        let sensor_ns = input.map_or(0, |input| input.header().sensor_ns);
        *self.newest.header_mut() = Header { sensor_ns, ..*header };
        self.report.computed += 1;
    }

    /// A message of the stage was recorded: compares it with the computed one, or goes on from it where there is none.
    pub fn compare(&mut self, recorded: &S::Output) {
        let is_newest = self.has_newest && self.newest.header().sequence == recorded.header().sequence;
        if !is_newest || self.is_judged {
            self.report.not_compared += 1;
            return;
        }
        self.is_judged = true;
        if !self.knows_state {
            self.go_on_from(recorded);
            return;
        }
        self.report.compared += 1;
        // Who has sent it, and when, no stage computes; a pulse of the other instance tells its own.
        let Header { generation, published_ns, .. } = *recorded.header();
        let header = *self.newest.header();
        *self.newest.header_mut() = Header { generation, published_ns, ..header };
        let (was, is) = (bytes_of(recorded), bytes_of(&*self.newest));
        if let Some(found) = Difference::between(self.topic, recorded.header(), was, is, &self.description) {
            self.report.differing += 1;
            self.report.first_difference.get_or_insert(found);
        }
    }

    /// Finds out what the message was computed from: the one before it, nothing, or something that is not known.
    fn follow(&mut self, header: &Header) {
        let before = *self.newest.header();
        let goes_on = self.has_newest && header.sequence == before.sequence + 1;
        if header.sequence == 0 {
            self.stage.begin_anew();
            self.knows_state = true;
        } else if !goes_on {
            self.knows_state = false;
        } else if header.generation != before.generation && self.knows_state {
            self.stage.resume(&self.newest);
        }
        (self.has_newest, self.is_judged) = (true, false);
        *self.newest.header_mut() = *header;
    }

    fn go_on_from(&mut self, recorded: &S::Output) {
        self.stage.resume(recorded);
        *self.newest = *recorded;
        self.knows_state = true;
        self.report.resumed += 1;
        self.report.not_compared += 1;
    }
}
