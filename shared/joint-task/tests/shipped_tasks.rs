//! The task files that the project ships make the networks that they should.
#![allow(clippy::unwrap_used)]

use coact_joint_task::NetworkPlan;
use coact_messages::LayerKind;
use std::path::Path;

#[test]
fn toy_vehicle_has_every_layer_and_every_population() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
    let (task, plan) = NetworkPlan::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let count = |kind| plan.populations_of(kind).len();
    assert_eq!(count(LayerKind::ActionObservation), task.acts.len());
    assert_eq!(count(LayerKind::ActionSimulation), task.chains.len());
    assert_eq!(count(LayerKind::ActionExecution), task.actions.len());
    println!(
        "{} populations, {} channels, {} synapses",
        plan.populations.len(),
        plan.channels.len(),
        plan.synapses.len()
    );
}
