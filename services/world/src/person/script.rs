use super::intention::{Choice, Intention, View};
use super::{Errand, PersonMemory};

/// A written sequence of actions: what the person does, whether the plan allows it or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    pub(crate) entries: Vec<Entry>,
}

/// One line of a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Entry {
    pub start: Start,
    pub deed: Deed,
}

/// When a scripted action is due.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Start {
    /// At this tick.
    At(u64),
    /// So many ticks after the end of the action before.
    After(u64),
}

/// What is scripted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Deed {
    /// Rest for so many ticks.
    Idle(u64),
    /// Carry out this chain: index into `Task::chains`.
    Chain(usize),
}

/// How soon the person looks again whether the scripted part has come within reach, ticks.
const LOOK_AGAIN: u64 = 100;
/// Rest after the last line, ticks.
const AT_THE_END: u64 = 1000;

impl Script {
    pub(super) fn next(&self, view: &View, memory: &mut PersonMemory) -> Choice {
        let Some(entry) = self.entries.get(memory.script as usize) else { return Choice::Rest(AT_THE_END) };
        let due = match entry.start {
            Start::At(tick) => tick,
            Start::After(delay) => memory.ended + delay,
        };
        if view.tick < due {
            return Choice::Rest(due - view.tick);
        }
        match entry.deed {
            Deed::Idle(ticks) => {
                memory.script += 1;
                memory.ended = view.tick + ticks;
                Choice::Rest(ticks)
            }
            Deed::Chain(chain) => match intend(view, chain) {
                None => Choice::Rest(LOOK_AGAIN),
                Some(intention) => {
                    memory.script += 1;
                    Choice::Begin(intention)
                }
            },
        }
    }
}

/// The intention to carry out `chain` now; none while no part for it is within reach.
fn intend(view: &View, chain: usize) -> Option<Intention> {
    let (errand, kind) = (view.errand(chain), view.task.chains[chain].kind);
    let subgoal = view.task.goal_of(chain, |goal| view.parts.is_available(goal, view.task));
    if errand == Errand::Request {
        return Some(Intention { errand, chain, subgoal, part: None });
    }
    let own = view.own_part(kind).map(|part| Intention { errand, chain, subgoal, part: Some(part) });
    let offered = || view.take_offered().filter(|taking| taking.chain == chain);
    own.or_else(offered)
}
