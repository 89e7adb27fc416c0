use super::intention::{Choice, Intention, View};
use super::{Errand, Manner, PersonMemory};
use crate::slot::Slot;
use crate::staging::Staging;

/// A written sequence of actions: what the person does, whether the plan allows it or not; and what is arranged in the
/// scene meanwhile.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    pub(crate) entries: Vec<Entry>,
    pub(crate) staging: Staging,
}

/// One line of a script.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub start: Start,
    /// Bit i set: not before subgoal i is achieved.
    pub once: u64,
    pub deed: Deed,
    /// What the person says as it begins.
    pub say: Option<String>,
}

/// When a scripted action is due.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Start {
    /// At this tick.
    At(u64),
    /// So many ticks after the end of the action before, and after what it waits for.
    After(u64),
}

/// What is scripted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Deed {
    /// Rest for so many ticks.
    Idle(u64),
    /// Carry out this chain: index into `Task::chains`.
    Chain(usize, Manner),
}

/// How soon the person looks again whether the scripted part has come within reach, ticks.
const LOOK_AGAIN: u64 = 100;
/// How long the person waits for it before the action is given up, ticks.
const PATIENCE: u64 = 20_000;
/// Rest after the last line, ticks.
const AT_THE_END: u64 = 1000;

impl Script {
    /// What is said with entry `index`.
    pub(super) fn sentence(&self, index: usize) -> Option<&str> {
        self.entries.get(index)?.say.as_deref()
    }

    pub(super) fn next(&self, view: &View, memory: &mut PersonMemory) -> Choice {
        let index = memory.script as usize;
        let Some(entry) = self.entries.get(index) else { return Choice::Rest(AT_THE_END) };
        if view.parts.achieved() & entry.once != entry.once {
            memory.ended = view.tick;
            return Choice::Rest(LOOK_AGAIN);
        }
        let due = match entry.start {
            Start::At(tick) => tick,
            Start::After(delay) => memory.ended + delay,
        };
        if view.tick < due {
            return Choice::Rest(due - view.tick);
        }
        let choice = match entry.deed {
            Deed::Idle(ticks) => {
                memory.ended = view.tick + ticks;
                Choice::Rest(ticks)
            }
            Deed::Chain(chain, manner) => match intend(view, chain, manner) {
                Some(intention) => Choice::Begin(intention),
                None if !is_patience_over(view.tick, memory) => return Choice::Rest(LOOK_AGAIN),
                None => {
                    memory.skipped += 1;
                    memory.script += 1;
                    memory.waiting = 0;
                    memory.ended = view.tick;
                    return Choice::Rest(1);
                }
            },
        };
        memory.says = Slot::of(index);
        memory.script += 1;
        memory.waiting = 0;
        choice
    }
}

/// Whether the next action has waited for its part for too long.
fn is_patience_over(tick: u64, memory: &mut PersonMemory) -> bool {
    if memory.waiting == 0 {
        memory.waiting = tick.max(1);
    }
    tick > memory.waiting + PATIENCE
}

/// The intention to carry out `chain` now; none while no part for it is within reach.
fn intend(view: &View, chain: usize, manner: Manner) -> Option<Intention> {
    let (errand, kind) = (view.errand(chain), view.task.chains[chain].kind);
    let subgoal = view.goal(chain);
    if errand == Errand::Request {
        return Some(Intention { errand, chain, subgoal, part: None, manner });
    }
    let own = view.own_part(kind).map(|part| Intention { errand, chain, subgoal, part: Some(part), manner });
    let offered = || {
        let taking = view.take_offered().filter(|taking| taking.chain == chain)?;
        Some(Intention { manner, ..taking })
    };
    own.or_else(offered)
}
