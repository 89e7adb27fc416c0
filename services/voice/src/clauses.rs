//! Clauses, composed from the task's names and the robot's motor skills.

use crate::Goal;
use coact_joint_task::{Action, ActionType, Task};

/// What the person is about to do: why the robot does what it does.
pub(crate) fn inferred(task: &Task, goal: Goal) -> String {
    let chain = &task.chains[goal.chain];
    format!("You want to {} the {}.", chain.name, task.kinds[chain.kind].name)
}

/// That words and hand do not agree.
pub(crate) fn contradicted(task: &Task, said: usize, goal: Goal) -> String {
    let words = |chain: usize| {
        let chain = &task.chains[chain];
        format!("{} the {}", chain.name, task.kinds[chain.kind].name)
    };
    format!("You speak as if to {}, but your hand is about to {}.", words(said), words(goal.chain))
}

/// That a part lies where the person can take it.
pub(crate) fn at_hand(task: &Task, kind: usize) -> String {
    format!("There is a {} on your side.", task.kinds[kind].name)
}

/// That the robot lost a part.
pub(crate) fn lost(task: &Task, kind: usize) -> String {
    format!("I have lost the {}.", task.kinds[kind].name)
}

/// What the robot is about to do; nothing for a skill that is speech itself.
pub(crate) fn announced(task: &Task, action: &Action) -> Option<String> {
    let part = action.kind.map_or("part", |kind| task.kinds[kind].name.as_str());
    let goal = action.subgoal.map(|subgoal| task.subgoals[subgoal].name.as_str());
    Some(match (action.action_type, goal) {
        (ActionType::Insert, Some(goal)) => format!("I will put the {goal}."),
        (ActionType::Insert, None) => format!("I will put the {part} where it belongs."),
        (ActionType::Request, Some(goal)) => format!("Please give me the {part}: I want to put the {goal}."),
        (ActionType::Request, None) => format!("Please give me the {part}."),
        (ActionType::Receive, _) => format!("I will take the {part} from you."),
        (ActionType::Give, _) => format!("Here is the {part} for you."),
        (ActionType::Steady, Some(goal)) => format!("I will hold it steady for the {goal}."),
        (ActionType::Steady, None) => "I will hold it steady for you.".to_owned(),
        (ActionType::Point, _) => format!("Look, there is the {part}."),
        (ActionType::Report, _) => format!("I know of no other {part}."),
        (ActionType::Speak, _) => return None,
    })
}

/// What is wrong with bringing about `subgoal`, by the goal that is `meant` if that stands, and what could be done instead; `achieved`: bit i
/// is set when subgoal i is.
pub(crate) fn objected(
    task: &Task,
    subgoal: usize,
    meant: Option<Goal>,
    achieved: u64,
    available: &[usize],
) -> String {
    let name = &task.subgoals[subgoal].name;
    let is_achieved = achieved & (1 << subgoal) != 0;
    let (mut text, next) = match (is_achieved, meant.map(|goal| &task.chains[goal.chain])) {
        (true, _) => (format!("The {name} is done already"), "now we need"),
        _ if task.is_spared(subgoal, achieved) => {
            (format!("Nobody needs the {name} any more"), "now we need")
        }
        (false, Some(chain)) => {
            (format!("You cannot {} the {} yet", chain.name, task.kinds[chain.kind].name), "first we need")
        }
        (false, None) => (format!("The {name} cannot be done yet"), "first we need"),
    };
    let instead: Vec<String> = available
        .iter()
        .filter(|&&other| other != subgoal)
        .map(|&other| format!("the {}", task.subgoals[other].name))
        .collect();
    match instead.split_last() {
        None => {}
        Some((only, [])) => text.push_str(&format!("; {next} {only}")),
        Some((last, others)) => text.push_str(&format!("; {next} {} or {last}", others.join(", "))),
    }
    text.push('.');
    text
}
