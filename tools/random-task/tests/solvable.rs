//! Random tasks are read, have the shape that was asked for, and can be solved.
#![allow(clippy::unwrap_used)]

use coact_joint_task::{Agent, FindingKind, NetworkPlan, Task, check};
use coact_random_task::{RandomTask, ShapeError, TaskShape};
use proptest::prelude::*;
use rand::SeedableRng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg32;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Writes a task beside the network that it names.
fn write(folder: &Path, shape: TaskShape, seed: u64) -> PathBuf {
    let network = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/joint-action.toml");
    let text =
        RandomTask::new(shape, seed).to_toml().replace("../joint-action.toml", network.to_str().unwrap());
    let file = folder.join("random.toml");
    std::fs::write(&file, text).unwrap();
    file
}

/// Everything that comes before a subgoal, itself included.
fn before(task: &Task, subgoal: usize) -> BTreeSet<usize> {
    let mut all = BTreeSet::from([subgoal]);
    task.subgoals[subgoal].after.iter().for_each(|&earlier| all.extend(before(task, earlier)));
    all
}

/// Subgoals, predecessors and share of a shape that exists.
fn sizes() -> impl Strategy<Value = (usize, usize, f64)> {
    (3..=50_usize, 1..=16_usize, 0.0..=1.0).prop_filter("no such shape", |&(subgoals, most, share)| {
        TaskShape::new(subgoals, most, share).is_ok()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_random_task_has_its_shape_and_each_step_stands_on_one_that_comes_before_it(
        (subgoals, most, share) in sizes(),
        seed in any::<u64>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let shape = TaskShape::new(subgoals, most, share).unwrap();
        let (task, _) = NetworkPlan::load(&write(folder.path(), shape, seed)).unwrap();
        prop_assert_eq!(task.subgoals.len(), subgoals);
        prop_assert_eq!(task.parts.len(), subgoals);
        prop_assert_eq!(task.kinds.len(), shape.kinds());
        prop_assert_eq!(task.subgoals.iter().map(|subgoal| subgoal.after.len()).max(), Some(most));
        for (index, subgoal) in task.subgoals.iter().enumerate() {
            let below = before(&task, index);
            for (other, step) in task.subgoals.iter().enumerate() {
                let under = step.socket[..2] == subgoal.socket[..2] && step.socket[2] < subgoal.socket[2];
                prop_assert!(!under || below.contains(&other), "{} stands on {}", &subgoal.name, &step.name);
            }
        }
        for (index, part) in task.parts.iter().enumerate() {
            let apart = if part.workspace == Agent::Person { 0.06 } else { 0.095 };
            for other in task.parts[..index].iter().filter(|other| other.workspace == part.workspace) {
                let distance = (part.at[0] - other.at[0]).hypot(part.at[1] - other.at[1]);
                prop_assert!(distance >= apart, "{distance}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_alternatives_are_done_the_others_are_spared_and_the_task_is_completed(
        (subgoals, most, share) in sizes(),
        (offered, seed) in (0.0..=1.0, any::<u64>()),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let shape = TaskShape::new(subgoals, most, share).unwrap().with_choices(offered).unwrap();
        let (task, _) = NetworkPlan::load(&write(folder.path(), shape, seed)).unwrap();
        let of_choices: Vec<usize> = task.choices.iter().flat_map(|choice| choice.of.clone()).collect();
        prop_assert!(of_choices.len() <= (offered * subgoals as f64).round() as usize);
        prop_assert_eq!(of_choices.len(), of_choices.iter().collect::<BTreeSet<_>>().len(), "each once");
        let (mut achieved, mut random) = (0, Pcg32::seed_from_u64(seed));
        while !task.is_complete(achieved) {
            let due: Vec<usize> = (0..subgoals).filter(|step| task.is_available(*step, achieved)).collect();
            let step = due.choose(&mut random);
            prop_assert!(step.is_some(), "nothing can be done, with {achieved:b}");
            achieved |= 1 << step.unwrap();
        }
        for choice in &task.choices {
            prop_assert!(choice.is_made(achieved) && choice.of.iter().any(|step| achieved & (1 << step) == 0));
        }
    }
}

#[test]
fn half_of_the_steps_are_offered_where_that_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let shape = TaskShape::new(30, 4, 0.2).unwrap().with_choices(0.5).unwrap();
    let offered = (0..8).map(|seed| {
        let task = Task::load(&write(folder.path(), shape, seed)).unwrap();
        task.choices.iter().map(|choice| choice.of.len()).sum::<usize>()
    });
    let offered: Vec<usize> = offered.collect();
    assert!(offered.iter().all(|count| (8..=15).contains(count)), "{offered:?}");
}

#[test]
fn a_random_task_lacks_no_part_and_no_way_to_bring_it() {
    let folder = tempfile::tempdir().unwrap();
    for seed in 0..5 {
        let file = write(folder.path(), TaskShape::new(10, 3, 0.3).unwrap(), seed);
        for finding in check(&file).unwrap() {
            let lacking = matches!(finding.kind, FindingKind::MissingParts | FindingKind::UnreachableSubgoal);
            assert!(!lacking, "{finding:?}");
        }
    }
}

#[test]
fn the_same_seed_makes_the_same_task_and_another_one_another() {
    let shape = TaskShape::new(20, 4, 0.5).unwrap();
    assert_eq!(RandomTask::new(shape, 3), RandomTask::new(shape, 3));
    assert_ne!(RandomTask::new(shape, 3), RandomTask::new(shape, 4));
}

#[test]
fn what_there_is_no_task_of_is_refused_with_what_is_possible() {
    let refused = |subgoals, most, share| TaskShape::new(subgoals, most, share).unwrap_err().to_string();
    assert!(refused(51, 3, 0.0).contains("3 to 50"));
    assert!(refused(2, 1, 0.0).contains("3 to 50"));
    assert!(refused(5, 5, 0.0).contains("1 to 4"));
    assert!(refused(20, 17, 0.0).contains("1 to 16"));
    assert!(refused(20, 3, f64::NAN).contains("0 to 1"));
    assert!(matches!(TaskShape::new(20, 3, -0.1), Err(ShapeError::Share { .. })));
    let shape = TaskShape::new(20, 3, 0.0).unwrap();
    assert!(shape.with_choices(1.1).unwrap_err().to_string().contains("1.1 in choices; expected 0 to 1"));
}
