use crate::Checkpoints;
use crate::empty_files::EmptyFiles;
use coact_messages::topic;
use coact_pipeline::{MemoryReserve, Pipeline, Run, RunError};
use coact_realtime::{Bus, CheckpointStore, PortError, Reservation, TopicAnchors, monotonic_time};
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

/// The supervisor's part of the run's shared memory: it keeps every topic open, keeps each process's checkpoint and a place
/// for its replacement, and cleans up after the dead.
pub(crate) struct RunTopics {
    store: CheckpointStore,
    anchors: TopicAnchors,
    run: Run,
    pipeline: Pipeline,
    /// For the replacement of each process; released while it starts, where no other places are left for it.
    reservations: BTreeMap<String, Reservation>,
    /// The living processes for which nothing is reserved.
    unreserved: BTreeSet<String>,
    /// Shared memory for replacements; `None` before the run begins.
    reserve: Option<MemoryReserve>,
    bus: Bus,
    /// When the remains of the dead are removed.
    clean_at: Option<Duration>,
    failed: bool,
    /// Declared last: the others still open and clean up while they end.
    _empty_files: EmptyFiles,
}

impl RunTopics {
    /// From a replacement's readiness to the cleaning up after its predecessor. It takes up to 9 ms for each dead
    /// process, and must not delay the replacement's first cycles. Chosen by hand.
    const CLEANUP_DELAY: Duration = Duration::from_millis(100);
    /// From a death to the cleaning up, when no replacement gets ready before. Chosen by hand.
    const CLEANUP_WITHOUT_RECOVERY: Duration = Duration::from_secs(1);

    /// Creates all topics of the run; as a successor (`generation` above 0), opens them.
    ///
    /// # Errors
    /// Shared memory refuses it.
    pub(crate) fn create(run: &Run, pipeline: &Pipeline, generation: u32) -> Result<Self, PortError> {
        let folder = run.directory().parent().unwrap_or(run.directory());
        let empty_files = EmptyFiles::watch(folder.to_owned(), run.prefix());
        let bus = Bus::open(run, "supervisor", generation)?;
        if generation > 0 {
            // The places of the dead supervisor are needed again.
            bus.clean_dead();
        }
        let anchors = TopicAnchors::new(&bus, pipeline)?;
        let store = CheckpointStore::new(&bus)?;
        let mut topics = Self {
            store,
            anchors,
            run: run.clone(),
            pipeline: pipeline.clone(),
            reservations: BTreeMap::new(),
            unreserved: pipeline.processes.iter().map(|entry| entry.name.clone()).collect(),
            reserve: None,
            bus,
            clean_at: None,
            failed: false,
            _empty_files: empty_files,
        };
        topics.reserve()?;
        Ok(topics)
    }

    /// Reserves places for the replacement of each process that lives and for which none are.
    ///
    /// # Errors
    /// The first refusal; what else can be reserved, is.
    fn reserve(&mut self) -> Result<(), PortError> {
        let Self { run, pipeline, reservations, unreserved, .. } = self;
        let mut outcome = Ok(());
        unreserved.retain(|process| match Reservation::take(run, pipeline, process) {
            Ok(reservation) => {
                reservations.insert(process.clone(), reservation);
                false
            }
            Err(error) => {
                if outcome.is_ok() {
                    outcome = Err(error);
                }
                true
            }
        });
        outcome
    }

    /// Every process has opened its ports: allocates all of the run's memory, and as much again for replacements.
    ///
    /// # Errors
    /// There is not so much.
    pub(crate) fn reserve_memory(&mut self) -> Result<(), RunError> {
        self.reserve = Some(MemoryReserve::take(&self.run)?);
        Ok(())
    }

    /// After a recovery: for the next one.
    fn renew_reserves(&mut self) {
        if let Some(Err(error)) = self.reserve.as_ref().map(|reserve| reserve.renew(&self.run)) {
            tracing::warn!("a replacement may find no room: {error}");
            // To make ports now would touch memory that may not be there.
            return;
        }
        // Refused, it is tried again after the next death; the viewers that are there keep their places till then.
        if let Err(error) = self.reserve() {
            tracing::warn!("a replacement may find no place: {error}");
        }
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
            self.renew_reserves();
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
    fn publish(&mut self, process: &str) -> Option<String> {
        // A crash loop would use up the topic's writers: what is still to be cleaned is cleaned now.
        if self.clean_at.take().is_some() {
            self.bus.clean_dead();
        }
        self.clean_at = Some(monotonic_time() + Self::CLEANUP_WITHOUT_RECOVERY);
        if let Some(Err(error)) = self.reserve.as_ref().map(MemoryReserve::release) {
            tracing::warn!("a replacement may find no room: {error}");
        }
        // To give places back takes milliseconds: it is done only where there are no others.
        if self.anchors.crowd(process).is_some() {
            self.reservations.remove(process);
        }
        self.unreserved.remove(process);
        let outcome = self.store.publish(process);
        let published = outcome.as_ref().is_ok_and(|header| header.is_some());
        self.warn_once(outcome.map(drop));
        (topic::state_of(process).is_some() && !published).then(|| lost(process).to_owned())
    }

    fn poison(&mut self, process: &str) {
        self.store.poison(process);
    }

    fn drop_newest(&mut self, process: &str) -> Option<String> {
        let outcome = self.store.drop_newest(process);
        let dropped = outcome.as_ref().ok().copied().flatten();
        self.warn_once(outcome.map(drop));
        let header = dropped?;
        Some(format!("its state of cycle {} ended a replacement; lost: {}", header.cycle, lost(process)))
    }

    fn crowd(&self, process: &str) -> Option<String> {
        self.anchors.crowd(process)
    }

    fn recovered(&mut self, process: &str) {
        if !self.reservations.contains_key(process) {
            self.unreserved.insert(process.to_owned());
        }
        self.clean_at = Some(monotonic_time() + Self::CLEANUP_DELAY);
    }
}

/// What a process knows only from its checkpoint.
fn lost(process: &str) -> &'static str {
    match topic::stage(process) {
        "world" => "where the simulated parts and the person were",
        "perception" => "what was seen of parts and of the person's hand",
        "fields" => "remembered parts, achieved subgoals and the decision",
        "control" => "the movement under way and what the hand holds",
        _ => "its state",
    }
}
