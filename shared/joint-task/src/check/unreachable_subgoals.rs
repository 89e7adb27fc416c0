use super::examined_task::ExaminedTask;
use super::finding::{Finding, FindingKind};
use crate::{Act, ActionType, Agent};

/// Subgoals that neither of the two can bring about with parts that lie where they lie.
pub(super) fn find(examined: &ExaminedTask) -> Vec<Finding> {
    examined.subgoals().filter_map(|goal| without_parts_there(examined, goal)).collect()
}

/// The finding, if parts of the kind lie in workspaces only from which nobody can bring them; where there is no part at
/// all, that is another finding.
fn without_parts_there(examined: &ExaminedTask, goal: usize) -> Option<Finding> {
    let (task, subgoal) = (&examined.task, &examined.task.subgoals[goal]);
    let lies = |owner: &Agent| examined.parts(subgoal.kind, *owner) > 0;
    let owners: Vec<Agent> = [Agent::Robot, Agent::Person].into_iter().filter(lies).collect();
    if owners.is_empty() || owners.iter().any(|&from| can_bring(examined, goal, from)) {
        return None;
    }
    let kind = &task.kinds[subgoal.kind].name;
    let lacks = lacking(subgoal.side, owners[0]);
    Some(Finding {
        kind: FindingKind::UnreachableSubgoal,
        place: examined.place_of_subgoal(goal),
        what: format!("nobody can bring about {:?}: {lacks}", subgoal.name),
        why: format!(
            "the place is on the {}'s side, and {kind:?} lies with the {}",
            name(subgoal.side),
            name(owners[0])
        ),
        advice: format!("add what is missing, or lay a {kind:?} into the {}'s workspace", name(subgoal.side)),
    })
}

/// Whether a part from the workspace of `from` can come to the subgoal's place.
fn can_bring(examined: &ExaminedTask, goal: usize, from: Agent) -> bool {
    let can = |action_type: ActionType| has_action(examined, goal, action_type);
    match (from, examined.task.subgoals[goal].side) {
        (Agent::Robot, Agent::Robot) => can(ActionType::Insert),
        (Agent::Robot, Agent::Person) => can(ActionType::Give),
        (Agent::Person, Agent::Person) => has_chain(examined, goal, None),
        (Agent::Person, Agent::Robot) => {
            can(ActionType::Insert) && has_chain(examined, goal, Some(ActionType::Receive))
        }
    }
}

fn has_action(examined: &ExaminedTask, goal: usize, action_type: ActionType) -> bool {
    let kind = examined.task.subgoals[goal].kind;
    examined.task.actions.iter().any(|action| {
        action.action_type == action_type
            && action.subgoal.is_none_or(|own| own == goal)
            && action.kind.is_none_or(|own| own == kind)
    })
}

/// Whether a grasp of the person's shows a chain that serves the subgoal, and has an answer of this type.
fn has_chain(examined: &ExaminedTask, goal: usize, answer: Option<ActionType>) -> bool {
    let task = &examined.task;
    (0..task.chains.len()).any(|index| {
        let chain = &task.chains[index];
        let complement = task.complement(index, goal).map(|action| task.actions[action].action_type);
        chain.from == Agent::Person
            && matches!(chain.act, Act::Grasp { .. })
            && examined.served(index).any(|own| own == goal)
            && (answer.is_none() || answer == complement)
    })
}

/// What is missing when a part from `from` cannot come to a place on `side`.
fn lacking(side: Agent, from: Agent) -> &'static str {
    match (from, side) {
        (Agent::Robot, Agent::Robot) => "the robot has no [[action]] of type \"insert\" for it",
        (Agent::Robot, Agent::Person) => "the robot has no [[action]] of type \"give\" for it",
        (Agent::Person, Agent::Person) => {
            "no [[chain]] that a grip shows leads from the person's workspace to the person's side"
        }
        (Agent::Person, Agent::Robot) => {
            "there is no [[chain]] from the person's workspace to the robot's side whose answer is an [[action]] of \
             type \"receive\", or no action \"insert\" that would follow"
        }
    }
}

fn name(agent: Agent) -> &'static str {
    match agent {
        Agent::Robot => "robot",
        Agent::Person => "person",
    }
}
