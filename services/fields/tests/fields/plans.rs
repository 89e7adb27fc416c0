//! Plans of any breadth: a step becomes possible when all is done that comes before it, or as much of it as is enough, and not sooner.
#![allow(clippy::unwrap_used)]

use crate::harness::Harness;
use coact_joint_task::NetworkPlan;
use coact_messages::LayerKind;
use proptest::prelude::*;
use std::path::Path;
use toml::{Table, Value};

/// What comes before one step at most.
const MOST: usize = 16;
/// Longer than any transient of a layer whose time scale is 25 ms.
const SETTLED: u64 = 1000;
/// The last step, after all others.
const LAST: &str = "top floor on the columns";
/// The alternatives, where not all of them are needed.
const CHOICE: &str = "enough steps";

/// The toy vehicle's last step after so many others, which need nothing themselves.
fn broad(before: usize) -> Harness {
    broad_of_which(before, before)
}

/// The same where `enough` of the others are.
fn broad_of_which(before: usize, enough: usize) -> Harness {
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
    if enough < before {
        let choice = Table::from_iter([
            ("name".to_owned(), CHOICE.into()),
            ("of".to_owned(), Value::Array(names)),
            ("count".to_owned(), Value::Integer(enough as i64)),
        ]);
        task.insert("choice".into(), Value::Array(vec![Value::Table(choice)]));
        last.insert("after".into(), Value::Array(vec![CHOICE.into()]));
    } else {
        last.insert("after".into(), Value::Array(names));
    }
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

/// The steps that are not done.
fn left(done: &[bool]) -> Vec<String> {
    done.iter().enumerate().filter(|(_, done)| !**done).map(|(step, _)| format!("step {step}")).collect()
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

#[test]
fn a_choice_is_made_by_as_many_as_are_enough_and_spares_the_others() {
    for offered in 2..=MOST {
        for enough in 1..offered {
            let mut robot = broad_of_which(offered, enough);
            (1..enough).for_each(|index| robot.achieve(&format!("step {index}")));
            robot.run(SETTLED);
            let possible = robot.available();
            assert!(
                !last_is_possible(&robot),
                "{offered} steps, {} of {enough} done: {possible:?}",
                enough - 1
            );
            assert_eq!(possible.len(), offered - (enough - 1), "{possible:?}");
            robot.achieve("step 0");
            robot.run(200);
            assert_eq!(robot.available(), [LAST], "{offered} steps, of which {enough} are enough");
        }
    }
}

#[test]
fn of_places_that_are_alike_the_person_s_goal_is_one_at_any_time() {
    for places in 2..=MOST {
        let mut robot = broad(places);
        robot.lay_out();
        robot.act("rest", 1.0);
        robot.run(SETTLED);
        robot.act("rest", 0.0);
        robot.reaches_for("wheel", "top");
        let mut stood = 0;
        for _ in 0..SETTLED {
            robot.run(1);
            let goals = robot.peaks(LayerKind::Intention);
            assert!(goals.len() <= 1, "{places} places: {goals:?}");
            stood += goals.len();
        }
        assert!(stood > 500, "{places} places: a goal stood for {stood} ms");
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

    #[test]
    fn a_choice_stands_exactly_while_enough_is_done(
        offered in 2..=MOST,
        enough in 1..MOST,
        changes in prop::collection::vec((0..MOST, any::<bool>()), 1..12),
    ) {
        let enough = 1 + enough % (offered - 1);
        let mut robot = broad_of_which(offered, enough);
        let mut done = vec![false; offered];
        for (step, is_done) in changes {
            let step = step % offered;
            done[step] = is_done;
            let name = format!("step {step}");
            if is_done { robot.achieve(&name) } else { robot.undo(&name) }
            robot.run(SETTLED);
            let count = done.iter().filter(|done| **done).count();
            let expected = if count >= enough { vec![LAST.to_owned()] } else { left(&done) };
            prop_assert_eq!(robot.available(), expected, "{} of {:?}", enough, &done);
        }
    }
}
