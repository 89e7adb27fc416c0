use super::slots::Slots;
use super::{PlanningQuery, PlanningResult, SkillPlanner};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The planner of a [`Control`](crate::Control) that works in real time: to be run on a thread of its own.
#[derive(Debug)]
pub struct PlanningThread {
    planner: SkillPlanner,
    slots: Arc<Slots<PlanningQuery, PlanningResult>>,
}

impl PlanningThread {
    pub(super) fn new(planner: SkillPlanner, slots: Arc<Slots<PlanningQuery, PlanningResult>>) -> Self {
        Self { planner, slots }
    }

    /// Answers queries, for ever; once `freezes` is set, it stands still with the next one, as an injected fault.
    pub fn run(mut self, freezes: &AtomicBool) -> ! {
        self.slots.attend();
        loop {
            let (number, query) = self.slots.wait();
            if freezes.load(Ordering::Relaxed) {
                stand_still();
            }
            self.slots.answer(number, self.planner.plan(&query));
        }
    }
}

fn stand_still() -> ! {
    loop {
        std::thread::park();
    }
}
