use super::{PlanningQuery, PlanningResult, SkillPlanner};
use crossbeam::queue::ArrayQueue;
use std::sync::{Arc, OnceLock};
use std::thread::{self, Thread};

/// The planner of a [`Control`](crate::Control) that works in real time: to be run on a thread of its own.
#[derive(Debug)]
pub struct PlanningThread {
    planner: SkillPlanner,
    slots: Arc<Slots>,
}

/// A slot for the newest query and one for its result: neither side ever waits for the other.
#[derive(Debug)]
pub(super) struct Slots {
    query: ArrayQueue<PlanningQuery>,
    result: ArrayQueue<PlanningResult>,
    thread: OnceLock<Thread>,
}

impl PlanningThread {
    pub(super) fn new(planner: SkillPlanner, slots: Arc<Slots>) -> Self {
        Self { planner, slots }
    }

    /// Answers queries, for ever.
    pub fn run(mut self) -> ! {
        _ = self.slots.thread.set(thread::current());
        loop {
            match self.slots.query.pop() {
                Some(query) => _ = self.slots.result.force_push(self.planner.plan(&query)),
                None => thread::park(),
            }
        }
    }
}

impl Slots {
    pub fn ask(&self, query: &PlanningQuery) {
        _ = self.query.force_push(*query);
        self.thread.get().into_iter().for_each(Thread::unpark);
    }

    pub fn result(&self) -> Option<PlanningResult> {
        self.result.pop()
    }
}

impl Default for Slots {
    fn default() -> Self {
        Self { query: ArrayQueue::new(1), result: ArrayQueue::new(1), thread: OnceLock::new() }
    }
}
