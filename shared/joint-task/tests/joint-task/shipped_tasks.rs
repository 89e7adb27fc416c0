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

#[test]
fn the_way_into_a_socket_is_as_long_as_the_hole_or_the_axle() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
    let (task, _) = NetworkPlan::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let depth = |name: &str| {
        let goal = task.subgoals.iter().find(|goal| goal.name == name).unwrap();
        task.insertion_depth(goal.socket, goal.axis)
    };
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found}");
    // The axle ends 20 mm beyond the nut, with a round end of 6 mm; the nut sits 25 mm outside the wheel.
    close(depth("wheel on the robot's side"), 0.051);
    close(depth("wheel on the person's side"), 0.051);
    close(depth("nut on the robot's side"), 0.026);
    // The base is 30 mm thick, and columns stand 10 mm above its underside.
    close(depth("column 1 in its hole"), 0.02);
    assert_eq!(task.insertion_depth([-0.4, 0.6, task.scene.table_height], [0.0, 0.0, 1.0]), 0.0);
}
