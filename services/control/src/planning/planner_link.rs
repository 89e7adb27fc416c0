use super::slots::Slots;
use super::{
    PlannerDelay, PlannerWatch, PlannerWithin, PlanningQuery, PlanningResult, PlanningThread, SkillPlanner,
};
use crate::state::QueryId;
use coact_motion::SearchHeartbeat;
use std::sync::Arc;
use std::time::Duration;

/// Control's side of the planner: makes queries, and takes the results.
#[derive(Debug)]
pub(crate) struct PlannerLink {
    /// The newest query that was made here.
    asked: Option<QueryId>,
    /// Its answer, once it is there. It stays: a standby may have it before its stage has, and needs it when that one dies.
    answer: Option<PlanningResult>,
    watch: PlannerWatch,
    place: PlannerPlace,
}

/// Where movements are planned: within the step that asks, or by a [`PlanningThread`] beside the servo.
#[derive(Debug)]
enum PlannerPlace {
    Within(PlannerWithin),
    Beside { slots: Arc<Slots<PlanningQuery, PlanningResult>>, heartbeat: SearchHeartbeat },
}

impl PlannerLink {
    /// To a planner that answers at once, unless it is told to hold its answers back.
    pub fn within(planner: SkillPlanner) -> Self {
        Self::to(PlannerPlace::Within(PlannerWithin::new(planner)))
    }

    /// To a planner on a thread of its own.
    pub fn beside(planner: SkillPlanner) -> (Self, PlanningThread) {
        let (slots, heartbeat) = (Arc::new(Slots::new()), planner.heartbeat().clone());
        let thread = PlanningThread::new(planner, Arc::clone(&slots));
        (Self::to(PlannerPlace::Beside { slots, heartbeat }), thread)
    }

    fn to(place: PlannerPlace) -> Self {
        Self { asked: None, answer: None, watch: PlannerWatch::default(), place }
    }

    /// Looks whether the planner goes on; to be called once in each cycle.
    pub fn look(&mut self) {
        match &mut self.place {
            PlannerPlace::Within(planner) => planner.look(),
            PlannerPlace::Beside { slots, heartbeat } => self.watch.look(slots.owes(), heartbeat.beats()),
        }
    }

    /// From now on a planner that answers within the step holds its answers back.
    pub fn hold_back(&mut self, delay: PlannerDelay) {
        if let PlannerPlace::Within(planner) = &mut self.place {
            planner.hold_back(delay);
        }
    }

    /// Whether the planner hangs: it owes an answer, and does not go on. One that answers within the step cannot.
    pub fn hangs(&self, starves: impl FnOnce(Duration) -> bool) -> bool {
        self.watch.hangs(starves)
    }

    /// Makes this query; one that was not taken up yet is replaced.
    pub fn ask(&mut self, id: QueryId, query: &PlanningQuery) {
        self.asked = Some(id);
        self.answer = match &mut self.place {
            PlannerPlace::Within(planner) => Some(planner.plan(query)),
            PlannerPlace::Beside { slots, .. } => {
                slots.ask(*query);
                None
            }
        }
    }

    /// Whether it was the newest query that was made here.
    pub fn was_asked(&self, id: QueryId) -> bool {
        self.asked == Some(id)
    }

    /// The answer to the newest query, if it was this one.
    pub fn answer(&mut self, id: QueryId) -> Option<PlanningResult> {
        if !self.was_asked(id) {
            return None;
        }
        match &self.place {
            PlannerPlace::Within(planner) if !planner.is_through() => return None,
            PlannerPlace::Within(_) => {}
            PlannerPlace::Beside { slots, .. } => self.answer = self.answer.or_else(|| slots.result()),
        }
        self.answer
    }
}
