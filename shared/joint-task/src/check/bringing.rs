use super::finding::{Finding, FindingKind};
use super::subject::Subject;
use crate::{Act, ActionType, Agent};

/// Subgoals that neither of the two can bring about with parts that lie where they lie.
pub(super) fn unreachable(subject: &Subject) -> Vec<Finding> {
    subject.subgoals().filter_map(|goal| without_parts_there(subject, goal)).collect()
}

/// The finding, if parts of the kind lie in workspaces only from which nobody can bring them; where there is no part at
/// all, that is another finding.
fn without_parts_there(subject: &Subject, goal: usize) -> Option<Finding> {
    let (task, subgoal) = (&subject.task, &subject.task.subgoals[goal]);
    let lies = |owner: &Agent| subject.parts(subgoal.kind, *owner) > 0;
    let owners: Vec<Agent> = [Agent::Robot, Agent::Person].into_iter().filter(lies).collect();
    if owners.is_empty() || owners.iter().any(|&from| can_bring(subject, goal, from)) {
        return None;
    }
    let kind = &task.kinds[subgoal.kind].name;
    let lacks = lacking(subgoal.side, owners[0]);
    Some(Finding {
        kind: FindingKind::UnreachableSubgoal,
        place: subject.place_of_subgoal(goal),
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
fn can_bring(subject: &Subject, goal: usize, from: Agent) -> bool {
    let can = |action_type: ActionType| has_action(subject, goal, action_type);
    match (from, subject.task.subgoals[goal].side) {
        (Agent::Robot, Agent::Robot) => can(ActionType::Insert),
        (Agent::Robot, Agent::Person) => can(ActionType::Give),
        (Agent::Person, Agent::Person) => has_chain(subject, goal, None),
        (Agent::Person, Agent::Robot) => {
            can(ActionType::Insert) && has_chain(subject, goal, Some(ActionType::Receive))
        }
    }
}

fn has_action(subject: &Subject, goal: usize, action_type: ActionType) -> bool {
    let kind = subject.task.subgoals[goal].kind;
    subject.task.actions.iter().any(|action| {
        action.action_type == action_type
            && action.subgoal.is_none_or(|own| own == goal)
            && action.kind.is_none_or(|own| own == kind)
    })
}

/// Whether a grasp of the person's shows a chain that serves the subgoal, and has an answer of this type.
fn has_chain(subject: &Subject, goal: usize, answer: Option<ActionType>) -> bool {
    let task = &subject.task;
    (0..task.chains.len()).any(|index| {
        let chain = &task.chains[index];
        let complement = task.complement(index, goal).map(|action| task.actions[action].action_type);
        chain.from == Agent::Person
            && matches!(chain.act, Act::Grasp { .. })
            && subject.served(index).any(|own| own == goal)
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
