use crate::{Activity, Intention, PersonState, Surroundings, Undertaking, Variation};
use coact_period::cycles;
use coact_stage_state::Slot;
use std::time::Duration;

/// How soon the person looks again whether the scripted part has come within reach, cycles. Not sensitive.
const LOOK_AGAIN: u64 = cycles(Duration::from_millis(100));
/// How long the person waits for it before the action is left out, cycles. Chosen by hand.
const PATIENCE: u64 = cycles(Duration::from_secs(20));
/// Rest after the last line, cycles. Not sensitive: nothing follows.
const AT_THE_END: u64 = cycles(Duration::from_secs(1));

/// A written sequence of actions: what the person does, whether the plan allows it or not.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Script {
    /// One after the other.
    pub entries: Vec<ScriptEntry>,
}

/// One line of a script.
#[derive(Debug, Clone, PartialEq)]
pub struct ScriptEntry {
    /// When it is due.
    pub due: Due,
    /// Bit i set: not before subgoal i is achieved.
    pub once: u64,
    /// What the person does.
    pub action: ScriptedAction,
    /// What the person says as it begins.
    pub say: Option<String>,
}

/// When a scripted action is due.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Due {
    /// At this tick.
    At(u64),
    /// So many cycles after the end of the action before, and after what it waits for.
    After(u64),
}

/// What is scripted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScriptedAction {
    /// Rest for so many cycles.
    Idle(u64),
    /// Carry out this chain: index into `Task::chains`.
    Chain(usize, Variation),
}

impl Script {
    /// What is said with entry `index`.
    pub(crate) fn sentence(&self, index: usize) -> Option<&str> {
        self.entries.get(index)?.say.as_deref()
    }

    pub(crate) fn next(&self, around: &Surroundings, state: &mut PersonState) -> Undertaking {
        let index = state.script_done as usize;
        let Some(entry) = self.entries.get(index) else { return Undertaking::Rest(AT_THE_END) };
        if around.parts.achieved() & entry.once != entry.once {
            state.ended = around.tick;
            return Undertaking::Await(LOOK_AGAIN);
        }
        let due = match entry.due {
            Due::At(tick) => tick,
            Due::After(delay) => state.ended + delay,
        };
        if around.tick < due {
            return Undertaking::Rest(due - around.tick);
        }
        let choice = match entry.action {
            ScriptedAction::Idle(cycles) => {
                state.ended = around.tick + cycles;
                Undertaking::Rest(cycles)
            }
            ScriptedAction::Chain(chain, variation) => match intend(around, chain, variation) {
                Some(intention) => Undertaking::Begin(intention),
                None if !is_patience_over(around.tick, state) => return Undertaking::Await(LOOK_AGAIN),
                None => return leave_out(around.tick, state),
            },
        };
        state.to_say = Slot::of(index);
        state.script_done += 1;
        state.waiting_since = 0;
        choice
    }
}

/// Goes on without the next action.
fn leave_out(tick: u64, state: &mut PersonState) -> Undertaking {
    state.skipped += 1;
    state.script_done += 1;
    state.waiting_since = 0;
    state.ended = tick;
    Undertaking::Rest(1)
}

/// Whether the next action has waited for its part for too long.
fn is_patience_over(tick: u64, state: &mut PersonState) -> bool {
    if state.waiting_since == 0 {
        state.waiting_since = tick.max(1);
    }
    tick > state.waiting_since + PATIENCE
}

/// The intention to carry out `chain` now; none while no part for it is within reach.
fn intend(around: &Surroundings, chain: usize, variation: Variation) -> Option<Intention> {
    let (activity, kind) = (around.activity(chain), around.task.chains[chain].kind);
    let subgoal = around.goal(chain);
    if activity == Activity::Request {
        return Some(Intention { activity, chain, subgoal, part: None, variation });
    }
    let own =
        around.own_part(kind).map(|part| Intention { activity, chain, subgoal, part: Some(part), variation });
    let given = || {
        let receiving = around.receive().filter(|receiving| receiving.chain == chain)?;
        Some(Intention { variation, ..receiving })
    };
    own.or_else(given)
}
