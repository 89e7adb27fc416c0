//! With learned connections from observed acts to simulated chains, robot and partner still build the whole vehicle.
#![allow(clippy::unwrap_used)]

use crate::shipped::{configuration, settings};
use coact_lockstep::Lockstep;
use coact_period::cycles;
use coact_pipeline::RunSettings;
use std::time::Duration;

/// Time within which every assembly must be done: three times what it usually takes.
const LONGEST: u64 = cycles(Duration::from_secs(180));

#[test]
fn vehicle_is_built_with_a_learned_mapping() {
    let (configuration, folder) = (configuration(), tempfile::tempdir().unwrap());
    let text = std::fs::read_to_string(configuration.join("tasks/toy-vehicle.toml")).unwrap();
    let [network, learned] =
        ["joint-action.toml", "learned/toy-vehicle.toml"].map(|file| configuration.join(file));
    let task = folder.path().join("task.toml");
    let key = format!("learned = {learned:?}\nnetwork = {network:?}");
    std::fs::write(&task, text.replacen("network = \"../joint-action.toml\"", &key, 1)).unwrap();
    for seed in 1..=2 {
        let mut stages =
            Lockstep::new(&RunSettings { task: task.clone(), ..settings(seed, "synthetic") }).unwrap();
        while !stages.complete() && stages.ticks() < LONGEST {
            stages.step();
        }
        assert!(stages.complete(), "partner {seed}: only {:09b}", stages.truth.achieved);
    }
}
