use crate::inputs::Inputs;
use crate::state::{ControlState, DecisionState, FinishedAction, HandState, Skill, SkillState};
use coact_joint_task::{Action, ActionType};
use coact_messages::{Decision, NONE, ROBOT};
use coact_period::cycles;
use coact_stage_state::Slot;
use std::time::Duration;

/// How long a part that no decision concerns stays in the hand before it is put back. Chosen by hand, between a hand that is
/// not free and one that puts away what is needed next.
const PUT_BACK_AFTER: u64 = cycles(Duration::from_secs(5));
/// How long after a failure the same decision is carried out again. Chosen by hand: the person, or a part, may have moved by
/// then.
const RETRY_AFTER: u64 = cycles(Duration::from_secs(2));

/// The skill that the robot shall use now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SkillChoice {
    pub skill: Skill,
    /// Action that it serves.
    pub action: Slot,
    /// Kind of part that it is about.
    pub kind: Slot,
    /// Whether that action is not decided, but preshaped: the hand gets ready for it.
    pub prepares: bool,
}

impl SkillChoice {
    const PARK: Self = Self { skill: Skill::Park, action: Slot::EMPTY, kind: Slot::EMPTY, prepares: false };

    /// From the decision and what is held. A decision that was carried out is not carried out again.
    ///
    /// A held part that the decision does not concern stays in the hand, as long as the hand is not needed: then it
    /// is put back first. It is put back, too, when nothing has been decided for long, and when it cannot go where it belongs as it is held: then it is
    /// taken anew.
    pub fn of(state: &ControlState, inputs: &Inputs, actions: &[Action]) -> Self {
        let (held, decisions) = (state.hand.held(), &state.decisions);
        let decision = inputs.decision().filter(|decision| !is_finished(&decisions.finished, decision));
        let decided = decision.and_then(|decision| {
            let action = actions.get(decision.action as usize)?;
            let moves = !matches!(action.action_type, ActionType::Speak | ActionType::Report);
            moves.then_some((decision.action as usize, action))
        });
        let unfit = state.hand.is_unfit();
        let fits = |skill: &Skill| !(unfit && skill.brings_part());
        match decided {
            None if unfit || decisions.unneeded > PUT_BACK_AFTER => held.map_or(Self::PARK, Self::put_back),
            None => Self::preshaped(state, inputs, actions).unwrap_or(Self::PARK),
            Some((index, action)) => match Self::skill(action, held).filter(fits) {
                Some(skill) => {
                    Self { skill, action: Slot::of(index), kind: action.kind.into(), prepares: false }
                }
                None => held.map_or(Self::PARK, Self::put_back),
            },
        }
    }

    /// To get ready for the action that is preshaped in the fields, though nothing is decided: of those for which the hand can, the one whose population in
    /// AEL is nearest to its threshold; not for one that did not come.
    fn preshaped(state: &ControlState, inputs: &Inputs, actions: &[Action]) -> Option<Self> {
        let ready = |index: usize| Self::ready(index, actions.get(index)?, state.hand.held(), inputs);
        let present = state.skill.action.get().filter(|_| state.skill.prepares.is_set());
        let index = inputs.preshaped(present, |index| ready(index).is_some())?;
        let did_not_come = state.skill.is_parking() && state.skill.action == Slot::of(index);
        ready(index).filter(|_| !did_not_come)
    }

    /// To get ready for an action, if the hand can. Over the base, and where parts change hands, it would hide from the robot's eye what the person
    /// does there.
    fn ready(index: usize, action: &Action, held: Option<usize>, inputs: &Inputs) -> Option<Self> {
        let skill = Self::skill(action, held)?;
        let ready = Self { skill, action: Slot::of(index), kind: action.kind.into(), prepares: true };
        (matches!(skill, Skill::Pick | Skill::Insert) && ready.can_begin(inputs)).then_some(ready)
    }

    /// The skill that serves an action with this kind of part in the hand; none when another part must leave the hand first.
    fn skill(action: &Action, held: Option<usize>) -> Option<Skill> {
        Some(match (action.action_type, action.kind) {
            (ActionType::Steady, _) => Skill::Steady,
            (ActionType::Point, Some(_)) => Skill::Point,
            (ActionType::Insert, Some(kind)) if held == Some(kind) => Skill::Insert,
            (ActionType::Give, Some(kind)) if held == Some(kind) => Skill::Give,
            (ActionType::Receive, kind) if held.is_some() && held == kind => Skill::Park,
            (ActionType::Speak | ActionType::Report, _) | (_, None) => Skill::Park,
            _ if held.is_some() => return None,
            (ActionType::Insert | ActionType::Give, Some(_)) => Skill::Pick,
            (ActionType::Request, _) => Skill::Request,
            (ActionType::Receive, Some(_)) => Skill::Receive,
        })
    }

    fn put_back(held: usize) -> Self {
        Self { skill: Skill::PutBack, kind: Slot::of(held), ..Self::PARK }
    }

    /// The same without anything to do.
    pub fn parked(self) -> Self {
        Self { skill: Skill::Park, prepares: false, ..self }
    }

    /// Whether this is what the robot does already.
    pub fn is_under_way(&self, state: &SkillState) -> bool {
        state.skill == self.skill
            && state.prepares.is_set() == self.prepares
            && (self.skill == Skill::Park || (state.action == self.action && state.kind == self.kind))
    }

    /// Whether no decision asks for it.
    pub fn is_undecided(&self) -> bool {
        self.skill == Skill::Park || self.prepares
    }

    /// Whether the part that it needs from the robot's workspace lies there.
    pub fn can_begin(&self, inputs: &Inputs) -> bool {
        let is_there = |kind: usize| inputs.part(ROBOT, kind).is_some();
        self.skill != Skill::Pick || self.kind.get().is_some_and(is_there)
    }
}

/// Counts for how long nothing was decided, and forgets after a while what failed, or was done in vain: then the decision
/// counts again.
pub(crate) fn age(state: &mut DecisionState, hand: &HandState, inputs: &Inputs, actions: &[Action]) {
    let decided = inputs.decision().is_some_and(|decision| (decision.action as usize) < actions.len());
    state.unneeded = if decided || hand.is_empty() { 0 } else { state.unneeded.saturating_add(1) };
    state.silent = if decided { 0 } else { state.silent.saturating_add(1) };
    let finished = &mut state.finished;
    finished.age = finished.age.saturating_add(1);
    let action = finished.action.get().and_then(|action| actions.get(action));
    let undone = action.and_then(|action| action.subgoal).is_some_and(|subgoal| inputs.open(subgoal));
    let in_vain = action.is_some_and(|action| match action.action_type {
        ActionType::Insert => true,
        ActionType::Give => !action.kind.is_some_and(|kind| inputs.in_person_hand(kind)),
        _ => false,
    });
    if finished.age > RETRY_AFTER && (finished.failed.is_set() || (in_vain && undone)) {
        finished.action = Slot::EMPTY;
        state.misses = 0;
    }
}

/// The action that a decision names; empty when it names none.
pub(crate) fn decided_action(decision: &Decision) -> Slot {
    if decision.action == NONE { Slot::EMPTY } else { Slot::of(decision.action as usize) }
}

fn is_finished(finished: &FinishedAction, decision: &Decision) -> bool {
    finished.action == decided_action(decision) && finished.since == decision.since
}
