use super::slots::Slots;
use super::{PlannerWatch, PlanningQuery, PlanningResult, PlanningThread, SkillPlanner};
use coact_motion::SearchHeartbeat;
use std::sync::Arc;
use std::time::Duration;

/// Control's side of the planner: makes queries, and takes the results.
#[derive(Debug)]
pub(crate) struct PlannerLink {
    /// Number, in control's state, of the newest query that was made here; none when the state is another's since.
    asked: Option<u64>,
    watch: PlannerWatch,
    place: PlannerPlace,
}

/// Where movements are planned: within the step that asks, or by a [`PlanningThread`] beside the servo.
#[derive(Debug)]
enum PlannerPlace {
    Within { planner: Box<SkillPlanner>, result: Option<Box<PlanningResult>> },
    Beside { slots: Arc<Slots<PlanningQuery, PlanningResult>>, heartbeat: SearchHeartbeat },
}

impl PlannerLink {
    /// To a planner that answers at once.
    pub fn within(planner: SkillPlanner) -> Self {
        Self::to(PlannerPlace::Within { planner: Box::new(planner), result: None })
    }

    /// To a planner on a thread of its own.
    pub fn beside(planner: SkillPlanner) -> (Self, PlanningThread) {
        let (slots, heartbeat) = (Arc::new(Slots::new()), planner.heartbeat().clone());
        let thread = PlanningThread::new(planner, Arc::clone(&slots));
        (Self::to(PlannerPlace::Beside { slots, heartbeat }), thread)
    }

    fn to(place: PlannerPlace) -> Self {
        Self { asked: None, watch: PlannerWatch::default(), place }
    }

    /// Looks whether the planner goes on; to be called once in each cycle.
    pub fn look(&mut self) {
        if let PlannerPlace::Beside { slots, heartbeat } = &self.place {
            self.watch.look(slots.owes(), heartbeat.beats());
        }
    }

    /// Whether the planner hangs: it owes an answer, and does not go on. One that answers within the step cannot.
    pub fn hangs(&self, starves: impl FnOnce(Duration) -> bool) -> bool {
        self.watch.hangs(starves)
    }

    /// Makes the query that has this number in control's state; one that was not taken up yet is replaced.
    pub fn ask(&mut self, number: u64, query: &PlanningQuery) {
        self.asked = Some(number);
        match &mut self.place {
            PlannerPlace::Within { planner, result } => *result = Some(Box::new(planner.plan(query))),
            PlannerPlace::Beside { slots, .. } => slots.ask(*query),
        }
    }

    /// The state is another's from now on: of what was asked here it knows nothing, though its queries may have the same numbers.
    pub fn forget(&mut self) {
        self.asked = None;
    }

    /// Whether the query of this number was made here.
    pub fn was_asked(&self, number: u64) -> bool {
        self.asked == Some(number)
    }

    /// The result of the newest query, once, if that has this number.
    pub fn result(&mut self, number: u64) -> Option<PlanningResult> {
        if !self.was_asked(number) {
            return None;
        }
        match &mut self.place {
            PlannerPlace::Within { result, .. } => result.take().map(|result| *result),
            PlannerPlace::Beside { slots, .. } => slots.result(),
        }
    }
}
