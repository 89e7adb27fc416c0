use crate::{Origin, Place, Verdict};
use coact_messages::{Header, LAYOUT, Refusal, topic};
use coact_period::{PERIOD_NS, cycles};

/// A message may be so many cycles ahead of the reader's own: the writer's next cycle may begin while the reader looks.
const AHEAD: u64 = 1;
/// So many writers that were refused are remembered, so that no file is looked at for each of their messages. As many as a
/// topic can have at a time.
const STRANGERS: usize = 4;
/// A topic's stage, and its standby.
const PLACES: usize = 2;

/// Judges the messages of one topic, one after another, by header and origin: which of them is the next good one of the
/// topic's writer, or of its standby.
///
/// Header and origin come from whoever sent the message. Each is held against what the reader knows itself: the time, the
/// process that the run says is the writer, and the newest message that was good.
#[derive(Debug, Clone)]
pub struct Judge {
    /// Whether one stage writes the topic.
    one_writer: bool,
    /// Whether messages are in the order of their cycles.
    in_order: bool,
    /// How many cycles ago a message may be.
    lifetime: Option<u64>,
    newest: Option<(Header, Option<Place>)>,
    /// Who sends, and the generation that it said: the stage, and its standby.
    writers: [Option<(u128, u32)>; PLACES],
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
            writers: [None; PLACES],
            strangers: [0; STRANGERS],
            next_stranger: 0,
        }
    }

    /// Whether the message is the next good one of its topic, as far as header and origin tell.
    ///
    /// `tick` is the present cycle, `now_ns` the present time; `place_of` says as what the run knows the origin in this
    /// generation: as the topic's stage or as its standby, or not at all. It is asked only about writers that are new.
    ///
    /// # Errors
    /// Why it is to be ignored.
    pub fn judge(
        &mut self,
        header: &Header,
        origin: Origin,
        (tick, now_ns): (u64, u64),
        place_of: impl FnOnce(u32, Origin) -> Option<Place>,
    ) -> Result<Verdict, Refusal> {
        self.judge_time(header, tick, now_ns)?;
        let place = match self.one_writer {
            true => Some(self.judge_writer(header.generation, origin, place_of)?),
            false => None,
        };
        match self.newest {
            Some((newest, by)) if self.in_order => self.judge_order(header, &newest, by == place),
            _ => Ok(Verdict::Next),
        }
    }

    /// The message was good in every respect: what comes next is held against it.
    pub fn accept(&mut self, header: &Header, origin: Origin) {
        self.newest = Some((*header, self.place(origin)));
    }

    fn place(&self, origin: Origin) -> Option<Place> {
        let known = |writer: &Option<(u128, u32)>| writer.is_some_and(|(id, _)| id == origin.publisher);
        [Place::Stage, Place::Standby].into_iter().find(|place| known(&self.writers[*place as usize]))
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

    /// One process writes for each place, in one generation, until the run knows one of a later generation.
    fn judge_writer(
        &mut self,
        generation: u32,
        origin: Origin,
        place_of: impl FnOnce(u32, Origin) -> Option<Place>,
    ) -> Result<Place, Refusal> {
        let generation_of =
            |judge: &Self, place| judge.writers[place as usize].map(|(_, generation)| generation);
        if let Some(place) = self.place(origin) {
            return if generation_of(self, place) == Some(generation) {
                Ok(place)
            } else {
                Err(Refusal::Writer)
            };
        }
        if self.strangers.contains(&origin.publisher) {
            return Err(Refusal::Writer);
        }
        let place = place_of(generation, origin);
        let refusal = match place.map(|place| (place, generation_of(self, place))) {
            Some((_, Some(newest))) if generation < newest => Refusal::Generation,
            Some((place, newest)) if newest != Some(generation) => {
                self.writers[place as usize] = Some((origin.publisher, generation));
                return Ok(place);
            }
            _ => Refusal::Writer,
        };
        self.strangers[self.next_stranger] = origin.publisher;
        self.next_stranger = (self.next_stranger + 1) % STRANGERS;
        Err(refusal)
    }

    /// Sequences begin anew with a writer that found no checkpoint; cycles never do. Stage and standby do not wait for each
    /// other: of a cycle for which both have sent, the first message counts.
    fn judge_order(&self, header: &Header, newest: &Header, same_place: bool) -> Result<Verdict, Refusal> {
        if !same_place {
            return Ok(if header.cycle > newest.cycle { Verdict::Next } else { Verdict::SentAlready });
        }
        let same_writer = self.one_writer && header.generation == newest.generation;
        if same_writer && header.sequence <= newest.sequence {
            return Err(Refusal::Repeated);
        }
        if header.cycle < newest.cycle {
            return Err(Refusal::Backward);
        }
        Ok(Verdict::Next)
    }
}
