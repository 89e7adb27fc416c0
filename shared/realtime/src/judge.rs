use crate::Origin;
use coact_messages::{Header, LAYOUT, Refusal, topic};
use coact_period::{PERIOD_NS, cycles};

/// A message may be so many cycles ahead of the reader's own: the writer's next cycle may begin while the reader looks.
const AHEAD: u64 = 1;
/// So many writers that were refused are remembered, so that no file is looked at for each of their messages. As many as a
/// topic can have at a time.
const STRANGERS: usize = 4;

/// Judges the messages of one topic, one after another, by header and origin: which of them is the next good one of the
/// topic's writer.
///
/// Header and origin come from whoever sent the message. Each is held against what the reader knows itself: the time, the
/// process that the run says is the writer, and the newest message that was good.
#[derive(Debug, Clone)]
pub struct Judge {
    /// Whether one process writes the topic.
    one_writer: bool,
    /// Whether messages are in the order of their cycles.
    in_order: bool,
    /// How many cycles ago a message may be.
    lifetime: Option<u64>,
    newest: Option<Header>,
    /// Who sends, and the generation that it said.
    writer: Option<(u128, u32)>,
    strangers: [u128; STRANGERS],
    next_stranger: usize,
}

impl Judge {
    /// A judge of `topic` who has seen nothing yet.
    pub fn of(topic: &str) -> Self {
        let entry = topic::find(topic);
        Self {
            one_writer: topic::writer(topic).is_some(),
            in_order: entry.is_none_or(|entry| !entry.writers.contains(&topic::ANYONE)),
            lifetime: entry.and_then(|entry| entry.lifetime).map(cycles),
            newest: None,
            writer: None,
            strangers: [0; STRANGERS],
            next_stranger: 0,
        }
    }

    /// Whether the message is the next good one of its topic, as far as header and origin tell.
    ///
    /// `tick` is the present cycle, `now_ns` the present time; `is_writer` says whether the run knows the origin as the
    /// topic's writer of this generation, and is asked only about writers that are new.
    ///
    /// # Errors
    /// Why it is to be ignored.
    pub fn judge(
        &mut self,
        header: &Header,
        origin: Origin,
        (tick, now_ns): (u64, u64),
        is_writer: impl FnOnce(u32, Origin) -> bool,
    ) -> Result<(), Refusal> {
        self.judge_time(header, tick, now_ns)?;
        if self.one_writer {
            self.judge_writer(header.generation, origin, is_writer)?;
        }
        match self.newest {
            Some(newest) if self.in_order => self.judge_order(header, &newest),
            _ => Ok(()),
        }
    }

    /// The message was good in every respect: what comes next is held against it.
    pub fn accept(&mut self, header: &Header) {
        self.newest = Some(*header);
    }

    /// By what needs no memory.
    fn judge_time(&self, header: &Header, tick: u64, now_ns: u64) -> Result<(), Refusal> {
        let Header { layout, cycle, sensor_ns, published_ns, .. } = *header;
        if layout != LAYOUT {
            return Err(Refusal::Layout);
        }
        if cycle > tick + AHEAD || published_ns > now_ns + PERIOD_NS || sensor_ns > published_ns {
            return Err(Refusal::Future);
        }
        match self.lifetime {
            Some(lifetime) if tick.saturating_sub(cycle) > lifetime => Err(Refusal::Stale),
            _ => Ok(()),
        }
    }

    /// One process writes, in one generation, until the run knows one of a later generation.
    fn judge_writer(
        &mut self,
        generation: u32,
        origin: Origin,
        is_writer: impl FnOnce(u32, Origin) -> bool,
    ) -> Result<(), Refusal> {
        let id = origin.publisher;
        match self.writer {
            Some((writer, own)) if writer == id && own == generation => return Ok(()),
            Some((writer, _)) if writer == id => return Err(Refusal::Writer),
            Some((_, newest)) if generation < newest => return Err(Refusal::Generation),
            Some((_, newest)) if generation == newest => return Err(Refusal::Writer),
            _ if self.strangers.contains(&id) => return Err(Refusal::Writer),
            _ => {}
        }
        if !is_writer(generation, origin) {
            self.strangers[self.next_stranger] = id;
            self.next_stranger = (self.next_stranger + 1) % STRANGERS;
            return Err(Refusal::Writer);
        }
        self.writer = Some((id, generation));
        Ok(())
    }

    /// Sequences begin anew with a writer that found no checkpoint; cycles never do.
    fn judge_order(&self, header: &Header, newest: &Header) -> Result<(), Refusal> {
        let same_writer = self.one_writer && header.generation == newest.generation;
        if same_writer && header.sequence <= newest.sequence {
            return Err(Refusal::Repeated);
        }
        if header.cycle < newest.cycle {
            return Err(Refusal::Backward);
        }
        Ok(())
    }
}
