use super::examined_task::ExaminedTask;
use super::finding::{Finding, FindingKind};
use crate::Agent;

/// Kinds of which the scene holds fewer parts than the plan needs.
pub(super) fn find(examined: &ExaminedTask) -> Vec<Finding> {
    let task = &examined.task;
    let short = |kind: usize| {
        // What may be spared need not be possible: then the other is what is left to choose.
        let may_be_spared = |goal: &usize| task.choices.iter().any(|choice| choice.spares.contains(goal));
        let goals =
            examined.subgoals().filter(|goal| task.subgoals[*goal].kind == kind && !may_be_spared(goal));
        let goals: Vec<usize> = goals.collect();
        let parts = examined.parts(kind, Agent::Robot) + examined.parts(kind, Agent::Person);
        let first_without = *goals.get(parts)?;
        let name = &task.kinds[kind].name;
        Some(Finding {
            kind: FindingKind::MissingParts,
            place: examined.place_of_subgoal(first_without),
            what: format!("{} subgoals need a {name:?}, and {parts} lie on the table", goals.len()),
            why: format!("{:?} can never come about", task.subgoals[first_without].name),
            advice: format!("add a [[part]] of kind {name:?}, or take the subgoal out of the plan"),
        })
    };
    (0..task.kinds.len()).filter_map(short).collect()
}
