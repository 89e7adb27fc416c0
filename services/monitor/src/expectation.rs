use crate::Intentions;
use coact_joint_task::{ActionType, Task};
use coact_messages::{FieldFrame, LayerKind, PartnerError};

/// Which peak shows that the partner's action was understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Expectation {
    /// The complementary action's, in the action execution layer: index into `Task::actions`.
    Action(usize),
    /// The goal's, in the intention layer, where the task names no complementary action.
    Intention(usize),
}

impl Expectation {
    /// What a chain that serves a subgoal should be answered with; none for goals that the network does not know.
    pub(crate) fn new(task: &Task, intentions: &Intentions, chain: usize, subgoal: usize) -> Option<Self> {
        if chain >= task.chains.len() || subgoal >= task.subgoals.len() {
            return None;
        }
        let intention = || intentions.population(chain, subgoal).map(Self::Intention);
        task.complement(chain, subgoal).map(Self::Action).or_else(intention)
    }

    /// What corrects the person's error: speech about the subgoal, or pointing at the part that lies at hand. None for an
    /// action without error, and where the task has no such action.
    pub(crate) fn of_error(task: &Task, error: u32, subgoal: usize) -> Option<Self> {
        let kind = task.subgoals.get(subgoal)?.kind;
        let intention = [PartnerError::Early as u32, PartnerError::Done as u32].contains(&error);
        let at_hand = error == PartnerError::AtHand as u32;
        let answers = |action_type: ActionType, of: Option<usize>, own: Option<usize>| match action_type {
            ActionType::Speak => intention && of == Some(subgoal),
            ActionType::Point => at_hand && own == Some(kind),
            _ => false,
        };
        let action = task.actions.iter().position(|own| answers(own.action_type, own.subgoal, own.kind));
        action.map(Self::Action)
    }

    /// Its name, for the report.
    pub(crate) fn name(self, task: &Task, intentions: &Intentions) -> String {
        match self {
            Self::Action(action) => task.actions[action].name.clone(),
            Self::Intention(goal) => intentions.name(goal).unwrap_or_default().to_owned(),
        }
    }

    /// Cycle at which its peak crossed threshold; none while there is no peak.
    pub(crate) fn since(self, frame: &FieldFrame) -> Option<u64> {
        let (layer, index) = match self {
            Self::Action(action) => (LayerKind::ActionExecution, action),
            Self::Intention(goal) => (LayerKind::Intention, goal),
        };
        let population = frame.populations(layer).nth(index)?;
        Some(frame.since[population]).filter(|&since| since != 0)
    }

    /// Another peak of the same layer that rose after `onset` and before `grasp`, and when: a wrong answer.
    pub(crate) fn rival(self, frame: &FieldFrame, onset: u64, grasp: u64) -> Option<(Self, u64)> {
        let (layer, own, make): (_, _, fn(usize) -> Self) = match self {
            Self::Action(own) => (LayerKind::ActionExecution, own, Self::Action),
            Self::Intention(own) => (LayerKind::Intention, own, Self::Intention),
        };
        frame
            .populations(layer)
            .enumerate()
            .filter(|&(index, population)| index != own && frame.since[population] != 0)
            .map(|(index, population)| (make(index), frame.since[population]))
            .filter(|&(_, since)| since > onset && since <= grasp)
            .max_by_key(|&(_, since)| since)
    }
}
