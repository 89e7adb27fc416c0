//! A learned plan in a task file: comments stay, the task loads, and has the plan.
#![allow(clippy::unwrap_used)]

use coact_joint_task::Task;
use coact_learning::TaskText;
use std::path::Path;

#[test]
fn written_task_has_the_plan_and_keeps_everything_else() {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("learned.toml");
    let mut plan = vec![Vec::new(); 9];
    plan[1] = vec![0];
    plan[8] = vec![1, 7];
    let mut text = TaskText::read(&base).unwrap();
    text.set_plan(&plan);
    text.write(&out).unwrap();
    let (before, after) = (Task::load(&base).unwrap(), Task::load(&out).unwrap());
    let learned: Vec<Vec<usize>> = after.subgoals.iter().map(|goal| goal.after.clone()).collect();
    assert_eq!(learned, plan);
    assert_eq!((before.parts, before.chains, before.actions), (after.parts, after.chains, after.actions));
    let comments = |path: &Path| {
        let text = std::fs::read_to_string(path).unwrap();
        text.lines()
            .filter_map(|line| line.split_once('#').map(|(_, comment)| comment.to_owned()))
            .collect::<Vec<_>>()
    };
    assert_eq!(comments(&base), comments(&out));
}

#[test]
fn choices_that_a_step_comes_after_stay() {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/tea.toml");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("learned.toml");
    let mut text = TaskText::read(&base).unwrap();
    text.set_plan(&vec![Vec::new(); 7]);
    text.write(&out).unwrap();
    let (before, after) = (Task::load(&base).unwrap(), Task::load(&out).unwrap());
    let choices =
        |task: &Task| task.subgoals.iter().map(|goal| goal.after_choices.clone()).collect::<Vec<_>>();
    assert!(after.subgoals.iter().all(|goal| goal.after.is_empty()));
    assert_eq!(choices(&before), choices(&after));
}
