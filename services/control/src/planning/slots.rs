#[cfg(test)]
use super::modelled::{ArrayQueue, AtomicU64, OnceLock, Ordering, Thread, fence, thread};
#[cfg(not(test))]
use crossbeam::queue::ArrayQueue;
#[cfg(not(test))]
use std::sync::OnceLock;
#[cfg(not(test))]
use std::sync::atomic::{AtomicU64, Ordering, fence};
#[cfg(not(test))]
use std::thread::{self, Thread};

/// A slot for the newest query and one for its result, between one that asks and one thread that answers: neither side ever waits
/// for the other.
///
/// Both sides number the queries, for an answer to an earlier one may come at any time. In unit tests atomics and threads are
/// loom's, which tries every order in which the two sides can act, and every value that they can see.
#[derive(Debug)]
pub(super) struct Slots<Q, R> {
    query: ArrayQueue<(u64, Q)>,
    result: ArrayQueue<(u64, R)>,
    thread: OnceLock<Thread>,
    /// Number of the newest query; 0 when there was none. Only the one that asks uses it.
    asked: AtomicU64,
    /// Number of the newest query that was answered; 0 when none was.
    answered: AtomicU64,
}

impl<Q, R> Slots<Q, R> {
    pub fn new() -> Self {
        Self {
            query: ArrayQueue::new(1),
            result: ArrayQueue::new(1),
            thread: OnceLock::new(),
            asked: AtomicU64::new(0),
            answered: AtomicU64::new(0),
        }
    }

    /// Asks; a query that was not taken up yet is replaced.
    pub fn ask(&self, query: Q) {
        let number = self.asked.load(Ordering::Relaxed) + 1;
        self.asked.store(number, Ordering::Relaxed);
        _ = self.query.force_push((number, query));
        // With the fence of `attend`: either the thread is known here, or it sees the query before it sleeps for the first time.
        fence(Ordering::SeqCst);
        self.thread.get().into_iter().for_each(Thread::unpark);
    }

    /// The result of the newest query, once.
    pub fn result(&self) -> Option<R> {
        let (number, result) = self.result.pop()?;
        (number == self.asked.load(Ordering::Relaxed)).then_some(result)
    }

    /// Whether the newest query has no result yet. Once it is not owed, it is there.
    pub fn owes(&self) -> bool {
        self.answered.load(Ordering::Acquire) != self.asked.load(Ordering::Relaxed)
    }

    /// This thread answers from now on.
    pub fn attend(&self) {
        _ = self.thread.set(thread::current());
        fence(Ordering::SeqCst);
    }

    /// Waits for a query: its number, and itself. Only to be called by the thread that attends.
    pub fn wait(&self) -> (u64, Q) {
        loop {
            match self.query.pop() {
                Some(query) => return query,
                None => thread::park(),
            }
        }
    }

    /// Answers the query of this number.
    pub fn answer(&self, number: u64, result: R) {
        _ = self.result.force_push((number, result));
        self.answered.store(number, Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planning::PlannerWatch;
    use loom::sync::Arc;

    /// Queries in each model: enough for one that is answered, one that is replaced, and one that comes during the answer.
    const QUERIES: u64 = 3;
    /// How often a thread is interrupted in favour of the other one: the errors that we have tried show with two.
    const PREEMPTIONS: usize = 3;

    /// Tries everything that can happen between one that asks, and looks for results, as `asker` does, and a thread that answers
    /// each query by its double until it has answered the last one. Should that one be lost, loom finds that nothing goes on.
    fn in_every_order(asker: impl Fn(&Slots<u64, u64>) + Send + Sync + 'static) {
        let mut model = loom::model::Builder::new();
        model.preemption_bound = Some(PREEMPTIONS);
        model.check(move || {
            let slots = Arc::new(Slots::new());
            let of_thread = Arc::clone(&slots);
            let planner = loom::thread::spawn(move || {
                of_thread.attend();
                loop {
                    let (number, query) = of_thread.wait();
                    of_thread.answer(number, 2 * query);
                    if query == QUERIES {
                        return;
                    }
                }
            });
            asker(&slots);
            assert!(planner.join().is_ok());
            let (owes, mut watch) = (slots.owes(), PlannerWatch::default());
            (0..10_000).for_each(|_| watch.look(owes, 0));
            assert!(!watch.hangs(|_| false), "all is answered, and the planner is taken for one that hangs");
        });
    }

    #[test]
    fn no_query_is_lost_and_the_newest_is_answered() {
        in_every_order(|slots| (1..=QUERIES).for_each(|query| slots.ask(query)));
    }

    #[test]
    fn what_is_not_owed_is_there_and_is_the_newest_querys() {
        in_every_order(|slots| {
            for query in 1..=QUERIES {
                slots.ask(query);
                let (owed, result) = (slots.owes(), slots.result());
                assert!(owed || result.is_some(), "query {query} is answered, and its result is not there");
                assert!(result.is_none_or(|result| result == 2 * query), "{result:?} answers query {query}");
            }
        });
    }

    #[test]
    fn a_result_is_there_once_and_a_slow_asker_finds_the_newest() {
        in_every_order(|slots| {
            slots.ask(1);
            let early = slots.result();
            slots.ask(QUERIES);
            let late = slots.result();
            assert!(
                early.is_none_or(|result| result == 2) && late.is_none_or(|result| result == 2 * QUERIES)
            );
            assert!(late.is_none() || slots.result().is_none(), "a result comes twice");
        });
    }
}
