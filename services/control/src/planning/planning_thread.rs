use super::{PlanningQuery, PlanningResult, SkillPlanner};
use coact_motion::SearchHeartbeat;
use crossbeam::queue::ArrayQueue;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
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
    /// Number of the newest query that was answered; 0 when none was.
    answered: AtomicU64,
    /// Of the planner's searches.
    heartbeat: SearchHeartbeat,
}

impl PlanningThread {
    pub(super) fn new(planner: SkillPlanner, slots: Arc<Slots>) -> Self {
        Self { planner, slots }
    }

    /// Answers queries, for ever; once `freezes` is set, it stands still with the next one, as an injected fault.
    pub fn run(mut self, freezes: &AtomicBool) -> ! {
        _ = self.slots.thread.set(thread::current());
        loop {
            match self.slots.query.pop() {
                Some(_) if freezes.load(Ordering::Relaxed) => stand_still(),
                Some(query) => self.answer(&query),
                None => thread::park(),
            }
        }
    }

    fn answer(&mut self, query: &PlanningQuery) {
        let result = self.planner.plan(query);
        _ = self.slots.result.force_push(result);
        self.slots.answered.store(query.number, Ordering::Release);
    }
}

fn stand_still() -> ! {
    loop {
        thread::park();
    }
}

impl Slots {
    pub fn new(heartbeat: SearchHeartbeat) -> Self {
        Self {
            query: ArrayQueue::new(1),
            result: ArrayQueue::new(1),
            thread: OnceLock::new(),
            answered: AtomicU64::new(0),
            heartbeat,
        }
    }

    pub fn ask(&self, query: &PlanningQuery) {
        _ = self.query.force_push(*query);
        self.thread.get().into_iter().for_each(Thread::unpark);
    }

    pub fn result(&self) -> Option<PlanningResult> {
        self.result.pop()
    }

    pub fn answered(&self) -> u64 {
        self.answered.load(Ordering::Acquire)
    }

    pub fn beats(&self) -> u64 {
        self.heartbeat.beats()
    }
}
