use super::planning_thread::Slots;
use super::{PlannerWatch, PlanningQuery, PlanningResult, PlanningThread, SkillPlanner};
use std::sync::Arc;

/// Control's side of the planner: makes queries, and takes the results.
#[derive(Debug)]
pub(crate) struct PlannerLink {
    /// The newest query that was made here; a predecessor's is not known.
    asked: u64,
    watch: PlannerWatch,
    place: PlannerPlace,
}

/// Where movements are planned: within the step that asks, or by a [`PlanningThread`] beside the servo.
#[derive(Debug)]
enum PlannerPlace {
    Within { planner: Box<SkillPlanner>, result: Option<Box<PlanningResult>> },
    Beside(Arc<Slots>),
}

impl PlannerLink {
    /// To a planner that answers at once.
    pub fn within(planner: SkillPlanner) -> Self {
        Self::to(PlannerPlace::Within { planner: Box::new(planner), result: None })
    }

    /// To a planner on a thread of its own.
    pub fn beside(planner: SkillPlanner) -> (Self, PlanningThread) {
        let slots = Arc::new(Slots::new(planner.heartbeat().clone()));
        let thread = PlanningThread::new(planner, Arc::clone(&slots));
        (Self::to(PlannerPlace::Beside(slots)), thread)
    }

    fn to(place: PlannerPlace) -> Self {
        Self { asked: 0, watch: PlannerWatch::default(), place }
    }

    /// Looks whether the planner goes on; to be called once in each cycle.
    pub fn look(&mut self) {
        if let PlannerPlace::Beside(slots) = &self.place {
            self.watch.look(slots.answered() != self.asked, slots.beats());
        }
    }

    /// Whether the planner hangs: it owes an answer, and does not go on. One that answers within the step cannot.
    pub fn hangs(&self) -> bool {
        self.watch.hangs()
    }

    /// Makes a query; one that was not taken up yet is replaced.
    pub fn ask(&mut self, query: &PlanningQuery) {
        self.asked = query.number;
        match &mut self.place {
            PlannerPlace::Within { planner, result } => *result = Some(Box::new(planner.plan(query))),
            PlannerPlace::Beside(slots) => slots.ask(query),
        }
    }

    /// Whether the query of this number was made here.
    pub fn was_asked(&self, number: u64) -> bool {
        self.asked == number
    }

    /// The result of the query of this number, once.
    pub fn result(&mut self, number: u64) -> Option<PlanningResult> {
        let result = match &mut self.place {
            PlannerPlace::Within { result, .. } => result.take().map(|result| *result),
            PlannerPlace::Beside(slots) => slots.result(),
        };
        result.filter(|result| result.number == number)
    }
}
