//! What moves the simulated person and what reads her movements share nothing: no crate that knows of movements, and no file but the
//! task, which says nothing of how people move.
#![allow(clippy::unwrap_used)]

use crate::shipped::{configuration, settings};
use coact_fields::Network;
use coact_input_file::Files;
use coact_joint_task::{NetworkPlan, Task};
use coact_perception::{Perception, PreshapeModel};
use coact_pipeline::{Movement, RunSettings};
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_world::{Settings, World};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// Crates that both sides may be built on: they know of no hand that moves.
const OF_BOTH: [&str; 6] = [
    "coact-input-file",
    "coact-joint-task",
    "coact-messages",
    "coact-neural-field",
    "coact-period",
    "coact-stage-state",
];

/// Each of the workspace's crates with those that it is built on.
fn crates() -> BTreeMap<String, Vec<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let name = |of: &Value| of["name"].as_str().unwrap().to_owned();
    let built_on = |package: &Value| {
        let all = package["dependencies"].as_array().unwrap().iter();
        all.filter(|own| own["kind"].is_null() && own["path"].is_string()).map(name).collect()
    };
    metadata["packages"].as_array().unwrap().iter().map(|own| (name(own), built_on(own))).collect()
}

/// The crates that `roots` are made of, themselves among them.
fn made_of(crates: &BTreeMap<String, Vec<String>>, roots: &[&str]) -> BTreeSet<String> {
    let mut open: Vec<String> = roots.iter().map(|root| (*root).to_owned()).collect();
    let mut found = BTreeSet::new();
    while let Some(next) = open.pop() {
        if found.insert(next.clone()) {
            open.extend(crates[&next].iter().cloned());
        }
    }
    found
}

#[test]
fn person_and_perception_are_built_on_no_crate_that_knows_how_people_move() {
    let crates = crates();
    let person = made_of(&crates, &["coact-person"]);
    let decoder = made_of(&crates, &["coact-perception", "coact-fields"]);
    let both: Vec<_> = person.intersection(&decoder).map(String::as_str).collect();
    assert_eq!(both, OF_BOTH);
    assert!(!made_of(&crates, &["coact-world"]).contains("coact-perception"));
}

#[test]
fn person_and_perception_read_no_file_in_common_but_task_and_robot() {
    let folder = configuration().join("../data/reaches");
    let settings =
        RunSettings { movement: Movement::Recorded { folder, participant: 3 }, ..settings(1, "random") };
    let (_, by_the_world) = Files::noted(|| {
        let (task, robot) = (Task::load(&settings.task).unwrap(), Robot::load(&settings.robot).unwrap());
        let drive = SafetyLimits::load(&settings.safety).unwrap().drive;
        World::new(&task, &robot, Settings::of_run(&settings, &task, drive).unwrap()).unwrap()
    });
    let (_, by_the_decoder) = Files::noted(|| {
        let (task, plan) = NetworkPlan::load(&settings.task).unwrap();
        let model = PreshapeModel::load(&settings.model).unwrap();
        let robot = Robot::load(&settings.robot).unwrap();
        (Perception::new(&task, &model).unwrap().with_robot(robot), Network::new(plan, 1, 1).unwrap())
    });
    let names = |files: &Files| -> BTreeSet<String> {
        let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
        files.iter().map(|(path, _)| name(path)).collect()
    };
    let (world, decoder) = (names(&by_the_world), names(&by_the_decoder));
    assert!(world.contains("person.toml") && decoder.contains("preshape.toml"), "{world:?}, {decoder:?}");
    let both: Vec<_> = world.intersection(&decoder).map(String::as_str).collect();
    // The task names the network, in which nothing of the person is.
    assert_eq!(both, ["aros.toml", "aros.urdf", "joint-action.toml", "toy-vehicle.toml"]);
}
