use crate::monotonic_clock::now;
use crate::port::Reader;
use crate::refusals::topic_index;
use crate::run_view::RunView;
use crate::{Judge, Message, Origin, PortError, Refusals, Verdict, handles_left};
use coact_messages::{Header, Refusal, topic};
use std::marker::PhantomData;
use std::sync::Arc;

/// Reader of one topic. It keeps the newest good message where its writer wrote it: nothing is copied.
///
/// Each message is judged before anybody sees it: its layout, its time, its writer, its order and its contents. What is not
/// good is given back, counted ([`Bus::refusals`](crate::Bus::refusals)), and otherwise ignored: the message before it stays.
#[derive(Debug)]
pub struct Input<T: Message> {
    topic: String,
    port: Box<dyn Reader>,
    bench: Bench,
    received_ns: u64,
    /// Looks in a row that found nothing.
    silent: u32,
    message: PhantomData<T>,
}

/// A topic whose messages come again and again has fallen silent when so many looks in a row found nothing; some hundred of them
/// are what a usual restart takes. Chosen by hand.
const SILENT: u32 = 500;

/// The judge of one topic, with what judgement needs.
#[derive(Debug)]
struct Bench {
    judge: Judge,
    run: Arc<RunView>,
    refusals: Arc<Refusals>,
    writer: Option<String>,
    topic_index: u32,
    /// Whether its messages come again and again.
    is_steady: bool,
    /// A message came of somebody who is not known as the writer.
    met_stranger: bool,
}

impl<T: Message> Input<T> {
    pub(crate) fn new(
        topic: &str,
        port: Box<dyn Reader>,
        run: Arc<RunView>,
        refusals: Arc<Refusals>,
    ) -> Self {
        let bench = Bench {
            judge: Judge::of(topic),
            run,
            refusals,
            writer: topic::writer(topic).map(str::to_owned),
            topic_index: topic_index(topic),
            is_steady: topic::find(topic).is_some_and(|entry| entry.lifetime.is_some()),
            met_stranger: false,
        };
        Self { topic: topic.to_owned(), port, bench, received_ns: 0, silent: 0, message: PhantomData }
    }

    /// Takes in what has arrived, keeps the newest good message, and returns whether there was any.
    ///
    /// # Errors
    /// [`PortError::Refused`]; [`PortError::NoHandles`] where a new writer cannot be looked up: it would be ignored for ever.
    pub fn refresh(&mut self) -> Result<bool, PortError> {
        Ok(self.each(|_| {})? > 0)
    }

    /// Calls `visit` with every good message that has arrived, oldest first, and keeps the last; returns how many there were.
    ///
    /// # Errors
    /// As [`Input::refresh`].
    pub fn each(&mut self, mut visit: impl FnMut(&T)) -> Result<usize, PortError> {
        let Self { port, bench, .. } = self;
        let mut count = 0;
        let unreadable = port.receive(&mut |bytes, origin| {
            // The topic was opened for this message: its size and alignment are right.
            let Ok(message) = bytemuck::try_from_bytes(bytes) else { return false };
            let is_good = bench.is_good(message, origin);
            if is_good {
                visit(message);
                count += 1;
            }
            is_good
        })?;
        if unreadable {
            bench.refusals.count(bench.topic_index, Refusal::Unreadable);
        }
        self.silent = if count > 0 { 0 } else { self.silent.saturating_add(1) };
        let fell_silent = self.received_ns > 0 && bench.is_steady && self.silent == SILENT;
        if unreadable || fell_silent || std::mem::take(&mut bench.met_stranger) {
            handles_left().map_err(|cause| PortError::NoHandles { topic: self.topic.clone(), cause })?;
        }
        if count > 0 {
            self.received_ns = now();
        }
        Ok(count)
    }

    /// Name of the topic.
    pub fn topic(&self) -> &str {
        &self.topic
    }

    /// The newest good message taken in so far, however old it is.
    pub fn latest(&self) -> Option<&T> {
        self.port.newest().and_then(|bytes| bytemuck::try_from_bytes(bytes).ok())
    }

    /// Its header.
    pub fn header(&self) -> Option<&Header> {
        self.latest().map(T::header)
    }

    /// When it was taken in, ns of `CLOCK_MONOTONIC`; 0 when none was.
    pub fn received_ns(&self) -> u64 {
        self.received_ns
    }

    /// Waits for the message of `cycle` or a later one, at the longest until `until_ns`; returns whether it is there.
    ///
    /// An event may be older than the message that it announced, or come twice: only the message itself counts.
    ///
    /// # Errors
    /// As [`Input::refresh`].
    pub fn wait_for(&mut self, cycle: u64, until_ns: u64) -> Result<bool, PortError> {
        loop {
            self.refresh()?;
            if self.header().is_some_and(|header| header.cycle >= cycle) {
                return Ok(true);
            }
            let now = now();
            if now >= until_ns {
                return Ok(false);
            }
            self.port.wait(until_ns - now)?;
        }
    }
}

impl Bench {
    /// Judges a message, and counts it when it is not good.
    fn is_good<T: Message>(&mut self, message: &T, origin: Origin) -> bool {
        let Self { judge, run, refusals, writer, topic_index, met_stranger, .. } = self;
        let now_ns = now();
        let time = (run.tick_at(now_ns), now_ns);
        let place_of = |generation, origin| run.place_of(writer.as_deref()?, generation, origin);
        let verdict = judge
            .judge(message.header(), origin, time, place_of)
            .and_then(|verdict| message.check().map(|()| verdict).map_err(|_| Refusal::Implausible));
        match verdict {
            Ok(Verdict::Next) => judge.accept(message.header(), origin),
            Ok(Verdict::SentAlready) => {}
            Err(refusal) => {
                *met_stranger |= refusal == Refusal::Writer;
                refusals.count(*topic_index, refusal);
            }
        }
        verdict == Ok(Verdict::Next)
    }
}
