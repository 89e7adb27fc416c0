//! Run directories: found again, apart from each other, and gone when removed.
#![allow(clippy::unwrap_used)]

use coact_pipeline::{Ready, Run, RunSettings, WorldMode};
use std::path::PathBuf;

fn ready(process: &str) -> Ready {
    Ready {
        process: process.to_owned(),
        generation: 2,
        pid: 1,
        scheduler: "SCHED_OTHER".to_owned(),
        priority: 0,
        core: None,
        memory_locked: false,
        why_not: vec!["SCHED_FIFO: refused".to_owned()],
        resumed: true,
    }
}

#[test]
fn run_is_found_again_with_its_settings_and_its_start() {
    let settings = RunSettings {
        task: "/nowhere/task.toml".into(),
        seed: 7,
        partner: "synthetic".to_owned(),
        world: WorldMode::Kinematic,
        ..RunSettings::default()
    };
    let run = Run::create(settings).unwrap();
    assert_eq!(run.start_ns().unwrap(), None);
    run.start(123).unwrap();
    let found = Run::load(run.directory()).unwrap();
    assert_eq!(found, run);
    assert_eq!(found.start_ns().unwrap(), Some(123));
    assert!(found.owner_lives() && Run::all().contains(&run));
    run.remove().unwrap();
    assert!(!run.directory().exists() && !Run::all().contains(&run));
}

#[test]
fn other_iceoryx2_clients_find_root_and_prefix_in_the_run_directory() {
    let run = Run::create(RunSettings::default()).unwrap();
    let text = std::fs::read_to_string(run.directory().join("config/iceoryx2.toml")).unwrap();
    let config: toml::Table = text.parse().unwrap();
    assert_eq!(config["global"]["prefix"].as_str(), Some(run.prefix().as_str()));
    assert_eq!(config["global"]["root-path"].as_str(), run.iceoryx2_root().to_str());
    run.remove().unwrap();
}

#[test]
fn removing_one_run_leaves_the_other_alone() {
    let (first, second) =
        (Run::create(RunSettings::default()).unwrap(), Run::create(RunSettings::default()).unwrap());
    assert!(!first.prefix().starts_with(&second.prefix()) && !second.prefix().starts_with(&first.prefix()));
    let memory = |run: &Run| PathBuf::from(format!("/dev/shm/{}segment", run.prefix()));
    for run in [&first, &second] {
        std::fs::write(memory(run), "x").unwrap();
    }
    first.remove().unwrap();
    assert!(!memory(&first).exists() && memory(&second).exists() && second.directory().exists());
    second.remove().unwrap();
    assert!(!memory(&second).exists());
}

#[test]
fn readiness_is_known_for_the_generation_that_reported_it() {
    let run = Run::create(RunSettings::default()).unwrap();
    run.report_ready(&ready("fields")).unwrap();
    assert_eq!(run.ready("fields", 2).unwrap(), Some(ready("fields")));
    assert_eq!(run.ready("fields", 3).unwrap(), None);
    run.remove().unwrap();
}

#[test]
fn a_directory_without_a_run_says_why_once() {
    let error = Run::load("/no/such/run".as_ref()).unwrap_err();
    let shown = format!("{:#}", anyhow::Error::from(error));
    assert_eq!(shown.matches("No such file").count(), 1, "{shown}");
    assert!(shown.starts_with("/no/such/run/run.json: cannot be read: "), "{shown}");
}

#[test]
fn malformed_run_file_is_named() {
    let run = Run::create(RunSettings::default()).unwrap();
    std::fs::write(run.directory().join("run.json"), "{}").unwrap();
    let error = Run::load(run.directory()).unwrap_err().to_string();
    assert!(error.contains("run.json: missing field `id`"), "{error}");
    run.remove().unwrap();
}
