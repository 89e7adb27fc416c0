use anyhow::Context;
use coact_messages::{HandPoints, Refusal, Speech, topic};
use coact_period::PERIOD;
use coact_pipeline::Run;
use coact_realtime::{Bus, Input, Message, Refusals};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::time::{Duration, Instant};

/// Messages that may wait for the next cycle. Not sensitive: a cycle takes all of them.
const WAITING: usize = 8;

/// What programs outside the set tell the person's part of the world.
///
/// A thread listens beside the cycle: to open the port of somebody who begins to speak takes longer than a cycle has.
pub struct OutsideInput<T> {
    messages: Receiver<T>,
}

/// What is listened to, and how.
#[derive(Debug, Clone, Copy)]
struct Listening {
    topic: &'static str,
    /// Name of the listener in the run, and of its thread.
    names: [&'static str; 2],
    /// How often it is looked whether something was told.
    look_every: Duration,
    /// From one message to the next, in the long run; what is told faster comes from no person, and is ignored.
    spacing: Duration,
    /// By how much messages may come earlier than that for a while.
    ahead: Duration,
}

impl OutsideInput<Speech> {
    /// Begins to listen to [`topic::HEARD`] of `run`; what is not passed on is counted in `refusals`.
    ///
    /// Nobody says more than four sentences a second. Chosen by hand.
    ///
    /// # Errors
    /// The topic cannot be joined, or there can be no thread.
    pub fn speech(run: &Run, refusals: Arc<Refusals>) -> anyhow::Result<Self> {
        let listening = Listening {
            topic: topic::HEARD,
            names: ["world-speech-input", "speech input"],
            look_every: Duration::from_millis(10),
            spacing: Duration::from_millis(250),
            ahead: Duration::ZERO,
        };
        Self::open(run, refusals, listening)
    }
}

impl OutsideInput<HandPoints> {
    /// Begins to listen to [`topic::HAND`] of `run`; what is not passed on is counted in `refusals`.
    ///
    /// It looks in every cycle: whoever moves the hand sees it follow. What a pipe or a busy machine held up may come at once: as much as
    /// is not too old to count.
    ///
    /// # Errors
    /// The topic cannot be joined, or there can be no thread.
    pub fn hand(run: &Run, refusals: Arc<Refusals>) -> anyhow::Result<Self> {
        let listening = Listening {
            topic: topic::HAND,
            names: ["world-hand-input", "hand input"],
            look_every: PERIOD,
            spacing: Duration::from_nanos(1_000_000_000 / HandPoints::FASTEST),
            ahead: HandPoints::LIFETIME,
        };
        Self::open(run, refusals, listening)
    }
}

impl<T: Message + Send> OutsideInput<T> {
    fn open(run: &Run, refusals: Arc<Refusals>, listening: Listening) -> anyhow::Result<Self> {
        let (sender, messages) = sync_channel(WAITING);
        let (opened, outcome) = sync_channel(1);
        let (run, [name, thread]) = (run.clone(), listening.names);
        let listen = move || {
            let joined = Bus::open(&run, name, 0).map(|bus| bus.counting_in(refusals.clone()));
            match joined.and_then(|bus| Ok((bus.input::<T>(listening.topic)?, bus))) {
                Ok((input, _bus)) => {
                    opened.send(Ok(())).ok();
                    listen(input, listening, &sender, &refusals);
                }
                Err(error) => {
                    opened.send(Err(error)).ok();
                }
            }
        };
        std::thread::Builder::new().name(thread.into()).spawn(listen).context("no thread to listen")?;
        outcome.recv().context("the listening thread ended")??;
        Ok(Self { messages })
    }

    /// The next message.
    pub fn next(&self) -> Option<T> {
        self.messages.try_recv().ok()
    }

    /// The newest message; those before it are passed over.
    pub fn newest(&self) -> Option<T> {
        self.messages.try_iter().take(WAITING).last()
    }
}

fn listen<T: Message>(
    mut input: Input<T>,
    listening: Listening,
    sender: &SyncSender<T>,
    refusals: &Refusals,
) {
    let Listening { topic, look_every, spacing, ahead, .. } = listening;
    let index = topic::ALL.iter().position(|entry| entry.name == topic).unwrap_or_default() as u32;
    let mut due = Instant::now();
    loop {
        let mut is_wanted = true;
        let pass_on = |message: &T| {
            let now = Instant::now();
            due = due.max(now);
            if due - now > ahead {
                return refusals.count(index, Refusal::TooOften);
            }
            due += spacing;
            is_wanted &= !matches!(sender.try_send(*message), Err(TrySendError::Disconnected(_)));
        };
        if let Err(error) = input.each(pass_on) {
            return tracing::error!("the world hears nothing on {topic} any more: {error}");
        }
        if !is_wanted {
            return;
        }
        std::thread::sleep(look_every);
    }
}
