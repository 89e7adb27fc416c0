use anyhow::Context;
use coact_messages::{Speech, topic};
use coact_pipeline::Run;
use coact_realtime::{Bus, Input};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::time::Duration;

/// How often it is looked whether something was said.
const LISTEN_EVERY: Duration = Duration::from_millis(10);
/// Sentences that may wait for the next cycle.
const WAITING: usize = 8;

/// Listens beside the cycle: to open the port of somebody who begins to speak takes longer than a cycle has.
pub struct SpeechInput {
    sentences: Receiver<Speech>,
}

impl SpeechInput {
    /// Begins to listen to [`topic::HEARD`] of `run`.
    ///
    /// # Errors
    /// The topic cannot be joined, or there can be no thread.
    pub fn open(run: &Run) -> anyhow::Result<Self> {
        let (sender, sentences) = sync_channel(WAITING);
        let (opened, outcome) = sync_channel(1);
        let run = run.clone();
        let listen = move || {
            let joined = Bus::open(&run, "world-speech-input", 0);
            match joined.and_then(|bus| Ok((bus.input::<Speech>(topic::HEARD)?, bus))) {
                Ok((input, _bus)) => {
                    opened.send(Ok(())).ok();
                    listen(input, &sender);
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

fn listen(mut input: Input<Speech>, sender: &SyncSender<Speech>) {
    loop {
        let mut is_wanted = true;
        let pass_on = |speech: &Speech| {
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
