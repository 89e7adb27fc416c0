use crate::answer::Answer;
use crate::planner::Planner;
use crate::request::Request;
use crossbeam::queue::ArrayQueue;
use std::sync::{Arc, OnceLock};
use std::thread::{self, Thread};

/// Asks the planner, and takes its answers.
#[derive(Debug)]
pub(crate) struct Planning {
    /// The last question that was asked here; a predecessor's is not known.
    asked: u64,
    place: Place,
}

/// Where movements are planned: at once, within the step that asks, or by a [`PlanningThread`] beside the servo.
#[derive(Debug)]
enum Place {
    AtOnce { planner: Box<Planner>, answer: Option<Box<Answer>> },
    Beside(Arc<Slots>),
}

/// A slot for the newest question and one for its answer: neither side ever waits for the other.
#[derive(Debug)]
pub(crate) struct Slots {
    request: ArrayQueue<Request>,
    answer: ArrayQueue<Answer>,
    planner: OnceLock<Thread>,
}

/// The planner of a [`Control`](crate::Control) that works in real time: to be run on a thread of its own.
#[derive(Debug)]
pub struct PlanningThread {
    planner: Planner,
    slots: Arc<Slots>,
}

impl Planning {
    pub fn at_once(planner: Planner) -> Self {
        Self { asked: 0, place: Place::AtOnce { planner: Box::new(planner), answer: None } }
    }

    pub fn beside(planner: Planner) -> (Self, PlanningThread) {
        let (request, answer) = (ArrayQueue::new(1), ArrayQueue::new(1));
        let slots = Arc::new(Slots { request, answer, planner: OnceLock::new() });
        let place = Place::Beside(Arc::clone(&slots));
        (Self { asked: 0, place }, PlanningThread { planner, slots })
    }

    /// Asks; a question that was not taken up yet is replaced.
    pub fn ask(&mut self, request: &Request) {
        self.asked = request.id;
        match &mut self.place {
            Place::AtOnce { planner, answer } => *answer = Some(Box::new(planner.answer(request))),
            Place::Beside(slots) => {
                _ = slots.request.force_push(*request);
                slots.planner.get().into_iter().for_each(Thread::unpark);
            }
        }
    }

    /// Whether question `id` was asked here.
    pub fn was_asked(&self, id: u64) -> bool {
        self.asked == id
    }

    /// The answer to question `id`, once.
    pub fn answer(&mut self, id: u64) -> Option<Answer> {
        let answer = match &mut self.place {
            Place::AtOnce { answer, .. } => answer.take().map(|answer| *answer),
            Place::Beside(slots) => slots.answer.pop(),
        };
        answer.filter(|answer| answer.id == id)
    }
}

impl PlanningThread {
    /// Answers questions, for ever.
    pub fn run(mut self) -> ! {
        _ = self.slots.planner.set(thread::current());
        loop {
            match self.slots.request.pop() {
                Some(request) => _ = self.slots.answer.force_push(self.planner.answer(&request)),
                None => thread::park(),
            }
        }
    }
}
