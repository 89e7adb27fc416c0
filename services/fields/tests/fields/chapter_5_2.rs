//! Understanding partly occluded actions and anticipating what the person will need (chapter, section 5.2), from
//! percepts alone.
#![allow(clippy::unwrap_used)]

use crate::harness::Harness;
use coact_joint_task::Agent;
use coact_messages::LayerKind;

const PERSON_WHEEL: &str = "wheel on the person's side";
const ROBOT_WHEEL: &str = "wheel on the robot's side";

/// One wheel in each workspace, all of them memorised; then the person's hand goes out of sight.
fn hand_behind_the_occluder(person_has_a_wheel: bool, robot_has_a_wheel: bool) -> Harness {
    let mut robot = Harness::of("toy-vehicle");
    robot.lay_out();
    for (owner, has) in [(Agent::Person, person_has_a_wheel), (Agent::Robot, robot_has_a_wheel)] {
        robot.object(owner, "wheel", f64::from(has), f64::from(!has));
    }
    robot.act("rest", 1.0);
    robot.run(300);
    // The wheel is hidden from here on: neither seen nor gone.
    robot.object(Agent::Person, "wheel", 0.0, 0.0);
    robot.act("rest", 0.0);
    robot.act("reach", 1.0);
    robot.run(300);
    robot.act("reach", 0.0);
    robot.act("reach out of sight", 1.0);
    // No part but wheels is out of sight as well.
    if person_has_a_wheel {
        robot.bound_for("wheel");
    }
    robot.run(300);
    robot
}

#[test]
fn memory_of_the_wheel_decides_what_the_hidden_hand_is_about() {
    let robot = hand_behind_the_occluder(true, true);
    assert_eq!(robot.simulation().as_deref(), Some("insert: wheel"));
    assert_eq!(robot.intention().as_deref(), Some("insert: wheel on the person's side"));
}

#[test]
fn reach_and_plan_alone_only_preactivate_the_chains() {
    let robot = hand_behind_the_occluder(false, true);
    assert_eq!(robot.simulation(), None, "no wheel is known to lie there");
    assert_eq!(robot.intention(), None);
}

#[test]
fn a_hidden_hand_that_could_mean_either_is_not_guessed_at() {
    let robot = hand_behind_the_occluder(true, false);
    assert_eq!(robot.simulation(), None, "the wheel could be meant for either side");
}

#[test]
fn the_person_s_next_step_opens_before_the_present_one_is_done() {
    let robot = hand_behind_the_occluder(true, true);
    let available = robot.available();
    assert!(available.contains(&"nut on the person's side".to_owned()), "{available:?}");
    assert_eq!(robot.peaks(LayerKind::SubgoalsAchieved), [""; 0], "nothing is done yet");
    assert!(available.contains(&PERSON_WHEEL.to_owned()) && available.contains(&ROBOT_WHEEL.to_owned()));
}

#[test]
fn the_robot_serves_the_future_need() {
    let robot = hand_behind_the_occluder(true, true);
    assert_eq!(robot.decision().as_deref(), Some("give: nut on the person's side"));
    assert_eq!(robot.peaks(LayerKind::ActionExecution).len(), 1);
}

#[test]
fn a_nut_that_is_on_its_way_is_brought_when_the_hand_comes_out_again() {
    let mut robot = hand_behind_the_occluder(true, true);
    robot.run(500);
    robot.robot_holds("nut", 1.0);
    robot.run(300);
    robot.act("reach out of sight", 0.0);
    robot.act("top grip: wheel", 1.0);
    robot.person_holds("wheel", 1.0);
    robot.run(500);
    assert_eq!(robot.decision().as_deref(), Some("give: nut on the person's side"));
}

#[test]
fn without_an_occluder_the_base_is_steadied() {
    // The same scene, with the grip in full view.
    let mut robot = Harness::of("toy-vehicle");
    robot.lay_out();
    robot.object(Agent::Robot, "wheel", 1.0, 0.0);
    robot.act("rest", 1.0);
    robot.run(300);
    robot.act("rest", 0.0);
    robot.act("top grip: wheel", 1.0);
    robot.run(200);
    assert_eq!(robot.decision().as_deref(), Some("steady the base: wheel on the person's side"));
}
