//! Error detection and context-sensitive interpretation of a request gesture (chapter, section 5.3), and the errors
//! that the chapter's discussion proposes (section 6), from percepts alone.
#![allow(clippy::unwrap_used)]

use crate::harness::Harness;
use coact_joint_task::Agent;

const WHEELS_AND_NUTS: [&str; 4] = [
    "wheel on the person's side",
    "wheel on the robot's side",
    "nut on the person's side",
    "nut on the robot's side",
];

/// The toy vehicle with these steps done, the parts of those steps gone from the table.
fn after(done: &[&str]) -> Harness {
    let mut robot = Harness::of("toy-vehicle");
    robot.lay_out();
    for subgoal in done {
        robot.achieve(subgoal);
        let kind = robot.kind_of(subgoal);
        if kind != "wheel" && kind != "nut" || done.len() >= WHEELS_AND_NUTS.len() {
            robot.object(Agent::Person, &kind, 0.0, 1.0);
            robot.object(Agent::Robot, &kind, 0.0, 1.0);
        }
    }
    robot.act("rest", 1.0);
    robot.run(500);
    robot
}

fn show(robot: &mut Harness, act: &str, ticks: u64) {
    robot.act("rest", 0.0);
    robot.act("idle", 0.0);
    robot.act(act, 1.0);
    robot.run(ticks);
}

fn rest(robot: &mut Harness, after: &str, ticks: u64) {
    robot.act(after, 0.0);
    robot.act("rest", 1.0);
    robot.run(ticks);
}

#[test]
fn a_column_that_is_grasped_too_early_is_an_error_that_is_told() {
    let mut robot = after(&WHEELS_AND_NUTS);
    assert_eq!(robot.available(), ["column 1 in its hole"]);
    show(&mut robot, "top grip: column 4", 300);
    assert_eq!(robot.intention().as_deref(), Some("insert: column 4 in its hole"));
    assert_eq!(robot.error().as_deref(), Some("column 4 in its hole"));
    assert_eq!(robot.decision().as_deref(), Some("correct: column 4 in its hole"));
    rest(&mut robot, "top grip: column 4", 500);
    assert_eq!((robot.error(), robot.intention()), (None, None), "the error is over");
    show(&mut robot, "side grip: column 1", 300);
    assert_eq!(robot.intention().as_deref(), Some("hand over: column 1 in its hole"));
    assert_eq!(robot.error(), None);
    assert_eq!(robot.decision().as_deref(), Some("receive: column 1 in its hole"));
}

#[test]
fn a_request_that_names_nothing_is_understood_from_what_is_there_and_what_is_done() {
    let mut done = WHEELS_AND_NUTS.to_vec();
    done.push("column 1 in its hole");
    let mut robot = after(&done);
    assert_eq!(robot.available(), ["column 2 in its hole", "column 4 in its hole"]);
    show(&mut robot, "open hand", 400);
    assert_eq!(robot.simulation().as_deref(), Some("request: column 3"));
    assert_eq!(robot.intention().as_deref(), Some("request: column 3 in its hole"));
    assert_eq!(robot.error().as_deref(), Some("column 3 in its hole"));
    assert_eq!(robot.decision().as_deref(), Some("correct: column 3 in its hole"));
    rest(&mut robot, "open hand", 500);
    show(&mut robot, "top grip: column 4", 300);
    assert_eq!(robot.error(), None);
    assert_eq!(robot.decision().as_deref(), Some("steady the base: column 4 in its hole"));
}

#[test]
fn a_request_in_its_turn_is_no_error_and_is_answered() {
    let mut robot = after(&WHEELS_AND_NUTS[..2]);
    robot.object(Agent::Person, "wheel", 0.0, 1.0);
    robot.run(300);
    show(&mut robot, "open hand", 400);
    assert_eq!(robot.intention().as_deref(), Some("request: nut on the person's side"));
    assert_eq!(robot.error(), None);
    assert_eq!(robot.decision().as_deref(), Some("give: nut on the person's side"));
}

#[test]
fn what_lies_at_the_person_s_hand_is_pointed_to_instead_of_handed_over() {
    let mut robot = after(&WHEELS_AND_NUTS[..2]);
    robot.object(Agent::Person, "wheel", 0.0, 1.0);
    robot.object(Agent::Person, "nut", 1.0, 0.0);
    robot.run(300);
    show(&mut robot, "open hand", 500);
    assert_eq!(robot.intention().as_deref(), Some("request: nut on the person's side"));
    assert_eq!(robot.error().as_deref(), Some("at hand: nut"));
    assert_eq!(robot.decision().as_deref(), Some("point to: nut"));
}

#[test]
fn a_part_that_is_taken_for_what_is_done_is_an_error_that_is_told_and_the_robot_asks_for_nothing_meanwhile() {
    let mut robot = Harness::of("table-setting");
    robot.lay_out();
    for subgoal in
        ["saucer at the person's place", "cup on the person's saucer", "spoon at the person's place"]
    {
        robot.achieve(subgoal);
    }
    robot.act("rest", 1.0);
    robot.run(500);
    robot.act("idle", 1.0);
    robot.run(1500);
    assert_eq!(robot.decision().as_deref(), Some("request: saucer at the guest's place"));
    robot.act("reach", 1.0);
    show(&mut robot, "top grip: spoon", 400);
    assert_eq!(robot.error().as_deref(), Some("done: spoon at the person's place"));
    assert_eq!(robot.decision().as_deref(), Some("correct: spoon at the person's place"));
    robot.act("reach", 0.0);
    rest(&mut robot, "top grip: spoon", 800);
    assert_eq!(robot.error(), None, "the error is over");
}

/// The robot has a nut in its hand, on its way to its own side of the axle.
fn carrying_a_nut(another: bool, person_has_one: bool) -> Harness {
    let mut robot = after(&["wheel on the robot's side"]);
    robot.run(100);
    assert_eq!(robot.decision().as_deref(), Some("insert: nut on the robot's side"));
    robot.robot_holds("nut", 1.0);
    robot.object(Agent::Robot, "nut", f64::from(another), f64::from(!another));
    robot.object(Agent::Person, "nut", f64::from(person_has_one), f64::from(!person_has_one));
    robot.run(500);
    assert_eq!((robot.decision().as_deref(), robot.error()), (Some("insert: nut on the robot's side"), None));
    robot.robot_holds("nut", 0.0);
    robot.lost("nut", 1.0);
    robot.run(400);
    assert_eq!(robot.error().as_deref(), Some("lost: nut"));
    robot
}

#[test]
fn a_part_that_the_robot_lost_is_replaced_by_another_of_its_kind() {
    let robot = carrying_a_nut(true, false);
    assert_eq!(robot.decision().as_deref(), Some("insert: nut on the robot's side"));
}

#[test]
fn a_part_that_only_the_person_can_replace_is_asked_for() {
    let robot = carrying_a_nut(false, true);
    assert_eq!(robot.decision().as_deref(), Some("request: nut on the robot's side"));
}

#[test]
fn a_part_that_nobody_can_replace_is_reported() {
    let robot = carrying_a_nut(false, false);
    assert_eq!(robot.decision().as_deref(), Some("report the loss of: nut"));
}
