use crate::{Survivors, clock};
use coact_pipeline::{Pipeline, Run};
use coact_realtime::{Bus, Held, Keeper, PortError};
use std::time::Duration;

/// The supervisor's part of the run's shared memory: holds every topic, keeps the last message of each process.
pub(crate) struct KeptMessages {
    keeper: Keeper,
    _held: Held,
    bus: Bus,
    /// When the remains of the dead are removed.
    clean_at: Option<Duration>,
    failed: bool,
}

impl KeptMessages {
    /// After a recovery the remains of the dead wait so long: their removal disturbs nobody's start.
    const CALM: Duration = Duration::from_millis(100);

    /// Creates and holds all topics of the run.
    ///
    /// # Errors
    /// Shared memory refuses it.
    pub(crate) fn hold(run: &Run, pipeline: &Pipeline) -> Result<Self, PortError> {
        let bus = Bus::open(run, "supervisor", 0)?;
        let held = bus.hold_all(pipeline)?;
        let keeper = Keeper::new(&bus)?;
        Ok(Self { keeper, _held: held, bus, clean_at: None, failed: false })
    }

    /// The supervisor's way into the topics.
    pub(crate) fn bus(&self) -> &Bus {
        &self.bus
    }

    /// Takes in the newest messages, greets replacements, and removes the remains of the dead when that is due.
    pub(crate) fn poll(&mut self) {
        let outcome = self.keeper.poll();
        self.report(outcome);
        if self.clean_at.is_some_and(|due| clock::now() >= due) {
            self.clean_at = None;
            let cleaned = self.bus.clean_dead();
            tracing::debug!("removed what {cleaned} dead processes left in shared memory");
        }
    }

    /// Warns of the first failure: without its memory a replacement starts afresh, but it starts.
    fn report(&mut self, outcome: Result<(), PortError>) {
        if let (Err(error), false) = (outcome, self.failed) {
            self.failed = true;
            tracing::warn!("replacements start without memory: {error}");
        }
    }
}

impl Survivors for KeptMessages {
    fn offer(&mut self, process: &str) {
        // A crash loop would use up the topic's writers: what is still to be cleaned is cleaned now.
        if self.clean_at.take().is_some() {
            self.bus.clean_dead();
        }
        self.clean_at = Some(clock::now() + 10 * Self::CALM);
        let outcome = self.keeper.offer(process).map(drop);
        self.report(outcome);
    }

    fn recovered(&mut self, _: &str) {
        self.clean_at = Some(clock::now() + Self::CALM);
    }
}
