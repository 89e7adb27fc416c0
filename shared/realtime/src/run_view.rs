use crate::{Origin, Place, Schedule};
use coact_messages::topic;
use coact_pipeline::Run;
use std::sync::atomic::{AtomicU64, Ordering};

/// In the table of topics.
const SUPERVISOR: &str = "supervisor";

/// What the ports of a process know of their run: its present cycle, and which process is which.
#[derive(Debug)]
pub(crate) struct RunView {
    run: Run,
    /// Release of tick 0; 0 while that is not known.
    start_ns: AtomicU64,
}

impl RunView {
    pub(crate) fn new(run: &Run) -> Self {
        Self { run: run.clone(), start_ns: AtomicU64::new(0) }
    }

    /// The present cycle; 0 before the start of the run.
    ///
    /// Until the start is known, the run's directory is looked at each time: processes of a set are told before their first
    /// cycle, by [`RunView::start`].
    pub(crate) fn tick_at(&self, ns: u64) -> u64 {
        let mut start_ns = self.start_ns.load(Ordering::Relaxed);
        if start_ns == 0 {
            start_ns = self.run.start_ns().ok().flatten().unwrap_or(0);
            if start_ns == 0 {
                return 0; // and another thread may know it by now
            }
            self.start(start_ns);
        }
        Schedule { start_ns }.tick_at(ns)
    }

    pub(crate) fn start(&self, start_ns: u64) {
        self.start_ns.store(start_ns, Ordering::Relaxed);
    }

    /// Whether the process `name` of the run has reported, in this generation, that it is ready, and is the origin's process.
    /// The supervisor reports to nobody: it is the process that owns the run, of a later generation where it has adopted it.
    ///
    /// It reads a file, once for each writer that begins to send: to connect to one costs more.
    pub(crate) fn is(&self, name: &str, generation: u32, origin: Origin) -> bool {
        if name == SUPERVISOR {
            let owner = self.run.owner();
            return owner.is_ok_and(|owner| (owner.generation, owner.pid) == (generation, origin.pid));
        }
        self.run.ready(name, generation).is_ok_and(|ready| ready.is_some_and(|ready| ready.pid == origin.pid))
    }

    /// As what the origin's process writes the topics of `stage` in this generation; `None` if it may not. Like [`RunView::is`], it
    /// reads files.
    pub(crate) fn place_of(&self, stage: &str, generation: u32, origin: Origin) -> Option<Place> {
        if self.is(stage, generation, origin) {
            return Some(Place::Stage);
        }
        topic::standby(stage).filter(|standby| self.is(standby, generation, origin)).map(|_| Place::Standby)
    }

    /// Whether the origin's process is the supervisor of the run. It reads a file, too.
    pub(crate) fn is_supervisor(&self, origin: Origin) -> bool {
        self.run.owner().is_ok_and(|owner| owner.pid == origin.pid)
    }
}
