use crate::Checkpoints;
use coact_pipeline::{Pipeline, Run};
use coact_realtime::{Bus, CheckpointStore, PortError, TopicAnchors, monotonic_time};
use std::time::Duration;

/// The supervisor's part of the run's shared memory: it keeps every topic open, keeps each process's checkpoint, and
/// cleans up after the dead.
pub(crate) struct RunTopics {
    store: CheckpointStore,
    _anchors: TopicAnchors,
    bus: Bus,
    /// When the remains of the dead are removed.
    clean_at: Option<Duration>,
    failed: bool,
}

impl RunTopics {
    /// From a replacement's readiness to the cleaning up after its predecessor. It takes up to 9 ms for each dead
    /// process, and must not delay the replacement's first cycles. Chosen by hand.
    const CLEANUP_DELAY: Duration = Duration::from_millis(100);
    /// From a death to the cleaning up, when no replacement gets ready before. Chosen by hand.
    const CLEANUP_WITHOUT_RECOVERY: Duration = Duration::from_secs(1);

    /// Creates all topics of the run.
    ///
    /// # Errors
    /// Shared memory refuses it.
    pub(crate) fn create(run: &Run, pipeline: &Pipeline) -> Result<Self, PortError> {
        let bus = Bus::open(run, "supervisor", 0)?;
        let anchors = TopicAnchors::new(&bus, pipeline)?;
        let store = CheckpointStore::new(&bus)?;
        Ok(Self { store, _anchors: anchors, bus, clean_at: None, failed: false })
    }

    /// For the supervisor's own ports.
    pub(crate) fn bus(&self) -> &Bus {
        &self.bus
    }

    /// Takes in the newest messages, hands checkpoints to replacements, and cleans up after the dead when that is due.
    pub(crate) fn poll(&mut self) {
        let outcome = self.store.poll();
        self.warn_once(outcome);
        if self.clean_at.is_some_and(|due| monotonic_time() >= due) {
            self.clean_at = None;
            let cleaned = self.bus.clean_dead();
            tracing::debug!("removed what {cleaned} dead processes left in shared memory");
        }
    }

    /// Warns of the first failure: without its checkpoint a replacement starts afresh, but it starts.
    fn warn_once(&mut self, outcome: Result<(), PortError>) {
        if let (Err(error), false) = (outcome, self.failed) {
            self.failed = true;
            tracing::warn!("replacements start without a checkpoint: {error}");
        }
    }
}

impl Checkpoints for RunTopics {
    fn publish(&mut self, process: &str) {
        // A crash loop would use up the topic's writers: what is still to be cleaned is cleaned now.
        if self.clean_at.take().is_some() {
            self.bus.clean_dead();
        }
        self.clean_at = Some(monotonic_time() + Self::CLEANUP_WITHOUT_RECOVERY);
        let outcome = self.store.publish(process).map(drop);
        self.warn_once(outcome);
    }

    fn recovered(&mut self, _: &str) {
        self.clean_at = Some(monotonic_time() + Self::CLEANUP_DELAY);
    }
}
