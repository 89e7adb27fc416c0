use anyhow::Context;
use coact_messages::{Refusal, Speech, topic};
use coact_pipeline::Run;
use coact_realtime::{Bus, Input, Refusals};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::time::{Duration, Instant};

/// How often it is looked whether something was said.
const LISTEN_EVERY: Duration = Duration::from_millis(10);
/// Sentences that may wait for the next cycle.
const WAITING: usize = 8;
/// From one sentence to the next: nobody says more than four a second, and what is said faster comes from no person. Chosen by
/// hand.
const SENTENCE: Duration = Duration::from_millis(250);

/// Listens beside the cycle: to open the port of somebody who begins to speak takes longer than a cycle has.
pub struct SpeechInput {
    sentences: Receiver<Speech>,
}

impl SpeechInput {
    /// Begins to listen to [`topic::HEARD`] of `run`; what is not passed on is counted in `refusals`.
    ///
    /// # Errors
    /// The topic cannot be joined, or there can be no thread.
    pub fn open(run: &Run, refusals: Arc<Refusals>) -> anyhow::Result<Self> {
        let (sender, sentences) = sync_channel(WAITING);
        let (opened, outcome) = sync_channel(1);
        let run = run.clone();
        let listen = move || {
            let joined =
                Bus::open(&run, "world-speech-input", 0).map(|bus| bus.counting_in(refusals.clone()));
            match joined.and_then(|bus| Ok((bus.input::<Speech>(topic::HEARD)?, bus))) {
                Ok((input, _bus)) => {
                    opened.send(Ok(())).ok();
                    listen(input, &sender, &refusals);
                }
                Err(error) => {
                    opened.send(Err(error)).ok();
                }
            }
        };
        std::thread::Builder::new()
            .name("speech input".into())
            .spawn(listen)
            .context("no thread to listen")?;
        outcome.recv().context("the listening thread ended")??;
        Ok(Self { sentences })
    }

    /// The next sentence that was said.
    pub fn next(&self) -> Option<Speech> {
        self.sentences.try_recv().ok()
    }
}

fn listen(mut input: Input<Speech>, sender: &SyncSender<Speech>, refusals: &Refusals) {
    let index = topic::ALL.iter().position(|entry| entry.name == topic::HEARD).unwrap_or_default() as u32;
    let mut free_at = Instant::now();
    loop {
        let mut is_wanted = true;
        let pass_on = |speech: &Speech| {
            let now = Instant::now();
            if now < free_at {
                return refusals.count(index, Refusal::TooOften);
            }
            free_at = now + SENTENCE;
            is_wanted &= !matches!(sender.try_send(*speech), Err(TrySendError::Disconnected(_)));
        };
        if let Err(error) = input.each(pass_on) {
            return tracing::error!("the world hears nothing any more: {error}");
        }
        if !is_wanted {
            return;
        }
        std::thread::sleep(LISTEN_EVERY);
    }
}
