use super::examined_task::ExaminedTask;
use super::finding::{Finding, FindingKind};

/// Pairs of chains that the same act shows, with the same support, while both may be meant.
pub(super) fn find(examined: &ExaminedTask) -> Vec<Finding> {
    let chains = 0..examined.task.chains.len();
    let pairs = chains.flat_map(|one| (0..one).map(move |other| (other, one)));
    pairs.filter_map(|(one, other)| meant_at_once(examined, one, other)).collect()
}

fn meant_at_once(examined: &ExaminedTask, one: usize, other: usize) -> Option<Finding> {
    let task = &examined.task;
    let [first, second] = [one, other].map(|chain| &task.chains[chain]);
    if first.act != second.act || first.from != second.from {
        return None;
    }
    let pairs = examined.served(one).flat_map(|a| examined.served(other).map(move |b| (a, b)));
    let (a, b) = pairs.into_iter().find(|&(a, b)| examined.concur(a, b))?;
    let [a, b] = [a, b].map(|goal| &task.subgoals[goal].name);
    let act =
        task.acts.iter().position(|act| *act == first.act).map_or_else(String::new, |act| task.act_name(act));
    let named =
        |chain: usize| format!("{}: {}", task.chains[chain].name, task.kinds[task.chains[chain].kind].name);
    let same =
        if a == b { format!("{a:?} is open") } else { format!("{a:?} and {b:?} are open at the same time") };
    Some(Finding {
        kind: FindingKind::AmbiguousChain,
        place: examined.place_of_chain(other),
        what: format!("{act:?} shows both {:?} and {:?}, and both may be meant while {same}", named(one), named(other)),
        why: "observed movement, objects and plan support both alike: noise decides what the robot infers".into(),
        advice: "show one of them by another grip or gesture, let one of the subgoals come after the other, or lay the \
                 parts into different workspaces"
            .into(),
    })
}
