use super::{PlannerDelay, PlanningQuery, PlanningResult, SkillPlanner};
use coact_realtime::thread_time;

/// A planner that searches within the step that asks, and may hold its answers back as if it worked beside the servo.
#[derive(Debug)]
pub(crate) struct PlannerWithin {
    planner: Box<SkillPlanner>,
    delay: PlannerDelay,
    /// Cycles so far, and the one in which the searches that were asked for are through.
    now: u64,
    through: u64,
}

impl PlannerWithin {
    /// Holds nothing back.
    pub fn new(planner: SkillPlanner) -> Self {
        Self { planner: Box::new(planner), delay: PlannerDelay::None, now: 0, through: 0 }
    }

    /// From now on holds answers back.
    pub fn hold_back(&mut self, delay: PlannerDelay) {
        self.delay = delay;
    }

    /// A cycle begins.
    pub fn look(&mut self) {
        self.now += 1;
    }

    /// Searches. One that is still under way by the delay ends first.
    pub fn plan(&mut self, query: &PlanningQuery) -> PlanningResult {
        let began_ns = thread_time();
        let result = self.planner.plan(query);
        self.through = self.through.max(self.now) + self.delay.of(thread_time() - began_ns);
        result
    }

    /// Whether the answer to the newest query may be told.
    pub fn is_through(&self) -> bool {
        self.now >= self.through
    }
}
