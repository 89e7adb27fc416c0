//! Connections from observed acts to simulated chains that were learned, not given: the network infers as before.
#![allow(clippy::unwrap_used)]

use crate::harness::Harness;

/// The toy vehicle with the connections that `coact learn mapping` has learned.
fn learned() -> Harness {
    Harness::learned("toy-vehicle", "learned/toy-vehicle.toml")
}

/// The robot asks for a wheel, and the person's hand is on its way.
fn start() -> Harness {
    let mut robot = learned();
    robot.lay_out();
    robot.act("idle", 0.9);
    robot.act("rest", 1.0);
    robot.run(300);
    assert_eq!(robot.decision().as_deref(), Some("request: wheel on the robot's side"));
    robot.act("rest", 0.0);
    robot.act("idle", 0.0);
    robot.act("reach", 1.0);
    robot.run(200);
    assert_eq!(robot.intention(), None, "a reach alone tells nothing");
    robot
}

#[test]
fn grip_from_above_means_insertion_and_the_base_is_steadied() {
    let mut robot = start();
    robot.act("top grip: wheel", 1.0);
    robot.run(150);
    assert_eq!(robot.intention().as_deref(), Some("insert: wheel on the person's side"));
    assert_eq!(robot.decision().as_deref(), Some("steady the base: wheel on the person's side"));
}

#[test]
fn side_grip_means_a_handover_and_the_robot_prepares_to_receive() {
    let mut robot = start();
    robot.act("side grip: wheel", 1.0);
    robot.run(150);
    assert_eq!(robot.intention().as_deref(), Some("hand over: wheel on the robot's side"));
    assert_eq!(robot.decision().as_deref(), Some("receive: wheel on the robot's side"));
}

#[test]
fn mounted_wheel_opens_the_nut_s_subgoal_and_the_robot_goes_on() {
    let mut robot = start();
    robot.act("reach", 0.0);
    robot.act("top grip: wheel", 1.0);
    robot.run(300);
    robot.person_holds("wheel", 1.0);
    robot.run(1000);
    robot.achieve("wheel on the person's side");
    robot.person_holds("wheel", 0.0);
    robot.act("top grip: wheel", 0.0);
    robot.act("rest", 1.0);
    robot.run(400);
    assert_eq!(robot.available(), ["wheel on the robot's side", "nut on the person's side"]);
    assert_eq!(robot.intention(), None);
}

#[test]
fn no_chain_ignites_from_one_act_alone() {
    let acts = learned().task().acts.len();
    for act in 0..acts {
        let mut robot = learned();
        robot.act_at(act, 1.0);
        robot.run(2000);
        assert_eq!(robot.simulation(), None, "{}", robot.task().act_name(act));
    }
}
