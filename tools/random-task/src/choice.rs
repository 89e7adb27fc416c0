use crate::subgoal::Subgoal;
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg32;
use serde::Serialize;

/// Alternatives: of the steps `of`, `count` are enough.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Choice {
    name: String,
    of: Vec<String>,
    count: usize,
}

/// A choice offers so many steps at most.
const LARGEST: usize = 4;

/// Has choices offer the `share` of all steps, as far as there are steps to offer together: such that nothing stands on one of them, and
/// none of them comes before another. What came after one of them comes after the choice.
pub(crate) fn offer(share: f64, subgoals: &mut [Subgoal], random: &mut Pcg32) -> Vec<Choice> {
    let mut choices: Vec<Choice> = Vec::new();
    let mut offered = (share * subgoals.len() as f64).round() as usize;
    let mut open: Vec<usize> = (0..subgoals.len()).filter(|step| !carries(subgoals, *step)).collect();
    open.shuffle(random);
    while offered > 1
        && let Some(first) = open.pop()
    {
        let size = random.random_range(2..=offered.min(LARGEST));
        let mut group = vec![first];
        for &step in &open {
            if group.len() < size && group.iter().all(|own| are_apart(*own, step, subgoals, &choices)) {
                group.push(step);
            }
        }
        if group.len() > 1 {
            open.retain(|step| !group.contains(step));
            offered -= group.len();
            let name = format!("choice {}", choices.len() + 1);
            let of: Vec<String> = group.iter().map(|step| subgoals[*step].name.clone()).collect();
            come_after(&name, &of, subgoals);
            choices.push(Choice { name, count: random.random_range(1..of.len()), of });
        }
    }
    choices
}

/// Whether another part stands on that of this step.
fn carries(subgoals: &[Subgoal], step: usize) -> bool {
    let [x, y, z] = subgoals[step].socket.at;
    subgoals.iter().any(|other| other.socket.at[..2] == [x, y] && other.socket.at[2] > z)
}

/// Whether neither of two steps comes before the other.
fn are_apart(one: usize, other: usize, subgoals: &[Subgoal], choices: &[Choice]) -> bool {
    !all_before(one, subgoals, choices)[other] && !all_before(other, subgoals, choices)[one]
}

/// Which steps come before this one, itself included; those that a choice offers come before what comes after it.
fn all_before(step: usize, subgoals: &[Subgoal], choices: &[Choice]) -> Vec<bool> {
    let mut before = vec![false; subgoals.len()];
    let mut open = vec![step];
    while let Some(step) = open.pop() {
        if !std::mem::replace(&mut before[step], true) {
            for name in &subgoals[step].after {
                let choice = choices.iter().find(|choice| choice.name == *name);
                let names = choice.map_or(std::slice::from_ref(name), |choice| &choice.of);
                open.extend((0..subgoals.len()).filter(|other| names.contains(&subgoals[*other].name)));
            }
        }
    }
    before
}

/// Has what came after a step of the choice come after the choice instead.
fn come_after(choice: &str, of: &[String], subgoals: &mut [Subgoal]) {
    for subgoal in subgoals.iter_mut() {
        let count = subgoal.after.len();
        subgoal.after.retain(|earlier| !of.contains(earlier));
        if subgoal.after.len() < count {
            subgoal.after.push(choice.to_owned());
        }
    }
}
