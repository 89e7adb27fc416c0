//! Plans of any breadth: a step becomes possible when all is done that comes before it, however much that is, and not sooner.
#![allow(clippy::unwrap_used)]

mod harness;

use coact_joint_task::NetworkPlan;
use harness::Harness;
use proptest::prelude::*;
use std::path::Path;
use toml::{Table, Value};

/// What comes before one step at most.
const MOST: usize = 16;
/// Longer than any transient of a layer whose time scale is 25 ms.
const SETTLED: u64 = 1000;
/// The last step, after all others.
const LAST: &str = "top floor on the columns";

/// The toy vehicle's last step after so many others, which need nothing themselves.
fn broad(before: usize) -> Harness {
    let configuration = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let text = std::fs::read_to_string(configuration.join("tasks/toy-vehicle.toml")).unwrap();
    let mut task: Table = text.parse().unwrap();
    let subgoals = task["subgoal"].as_array().unwrap();
    let (first, last) = (subgoals[0].as_table().unwrap(), subgoals.last().unwrap().as_table().unwrap());
    let names: Vec<Value> = (0..before).map(|index| format!("step {index}").into()).collect();
    let step = |name: &Value| {
        let mut step = first.clone();
        step.insert("name".into(), name.clone());
        Value::Table(step)
    };
    let mut plan: Vec<Value> = names.iter().map(step).collect();
    let mut last = last.clone();
    last.insert("after".into(), Value::Array(names));
    plan.push(Value::Table(last));
    task.insert("subgoal".into(), Value::Array(plan));
    let network = configuration.join("joint-action.toml").display().to_string();
    task.insert("network".into(), network.into());
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("broad.toml");
    std::fs::write(&file, task.to_string()).unwrap();
    let (task, plan) = NetworkPlan::load(&file).unwrap();
    Harness::with(task, plan)
}

fn last_is_possible(robot: &Harness) -> bool {
    robot.available().iter().any(|name| name == LAST)
}

#[test]
fn a_step_waits_for_the_last_of_all_that_come_before_it() {
    for before in 1..=MOST {
        for missing in 0..before {
            let mut robot = broad(before);
            for index in (0..before).filter(|index| *index != missing) {
                robot.achieve(&format!("step {index}"));
            }
            robot.run(SETTLED);
            assert!(!last_is_possible(&robot), "{before} steps before it, without step {missing}");
            robot.achieve(&format!("step {missing}"));
            robot.run(200);
            assert!(last_is_possible(&robot), "{before} steps before it, all done");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_step_is_possible_exactly_while_all_is_done_that_comes_before_it(
        before in 1..=MOST,
        changes in prop::collection::vec((0..MOST, any::<bool>()), 1..12),
    ) {
        let mut robot = broad(before);
        let mut done = vec![false; before];
        for (step, is_done) in changes {
            let step = step % before;
            done[step] = is_done;
            let name = format!("step {step}");
            if is_done { robot.achieve(&name) } else { robot.undo(&name) }
            robot.run(SETTLED);
            prop_assert_eq!(last_is_possible(&robot), done.iter().all(|done| *done), "{:?}", &done);
        }
    }
}
