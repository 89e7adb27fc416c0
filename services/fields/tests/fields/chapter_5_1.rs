//! Pro-active behaviour and goal inference (chapter, section 5.1), from percepts alone.
#![allow(clippy::unwrap_used)]

use crate::harness::Harness;

const PERSON_WHEEL: &str = "wheel on the person's side";
const ROBOT_WHEEL: &str = "wheel on the robot's side";

/// All parts as the task lays them out, the person's hand at rest.
fn start() -> Harness {
    let mut robot = Harness::of("toy-vehicle");
    robot.lay_out();
    robot.act("rest", 1.0);
    robot
}

#[test]
fn nothing_is_decided_for_an_attentive_person_who_just_began_to_rest() {
    let mut robot = start();
    robot.run(1000);
    assert_eq!(robot.decision(), None);
    assert_eq!(robot.available(), [PERSON_WHEEL, ROBOT_WHEEL]);
}

#[test]
fn robot_requests_a_wheel_while_the_person_idles() {
    let mut robot = start();
    robot.act("idle", 0.9);
    robot.run(300);
    assert_eq!(robot.decision().as_deref(), Some("request: wheel on the robot's side"));
}

/// Column 1 lies with the person, and nothing else can be done before it is in its hole.
#[test]
fn what_the_plan_hangs_on_is_requested_at_once_where_the_person_has_no_step_of_the_own() {
    let mut robot = start();
    for wheel_or_nut in [PERSON_WHEEL, ROBOT_WHEEL, "nut on the person's side"] {
        robot.achieve(wheel_or_nut);
    }
    robot.run(500);
    assert_eq!(robot.decision().as_deref(), Some("insert: nut on the robot's side"));
    robot.achieve("nut on the robot's side");
    robot.run(300);
    assert_eq!(robot.available(), ["column 1 in its hole"]);
    assert_eq!(robot.decision().as_deref(), Some("request: column 1 in its hole"), "nobody idles yet");
}

#[test]
fn grip_from_above_makes_the_robot_give_up_its_own_intention_and_steady_the_base() {
    let mut robot = start();
    robot.act("idle", 0.9);
    robot.run(300);
    robot.act("rest", 0.0);
    robot.act("idle", 0.0);
    robot.act("reach", 1.0);
    robot.run(200);
    assert_eq!(robot.intention(), None, "a reach alone tells nothing");
    assert_eq!(robot.decision().as_deref(), Some("request: wheel on the robot's side"));
    robot.act("top grip: wheel", 1.0);
    robot.run(150);
    assert_eq!(robot.intention().as_deref(), Some("insert: wheel on the person's side"));
    assert_eq!(robot.decision().as_deref(), Some("steady the base: wheel on the person's side"));
}

#[test]
fn mounted_wheel_opens_the_nut_s_subgoal_and_leaves_the_robot_s_own() {
    let mut robot = start();
    robot.act("rest", 0.0);
    robot.act("top grip: wheel", 1.0);
    robot.run(300);
    robot.person_holds("wheel", 1.0);
    robot.run(1000);
    robot.achieve(PERSON_WHEEL);
    robot.person_holds("wheel", 0.0);
    robot.act("top grip: wheel", 0.0);
    robot.act("rest", 1.0);
    robot.run(400);
    assert_eq!(robot.available(), [ROBOT_WHEEL, "nut on the person's side"]);
    assert_eq!(robot.intention(), None);
    assert_eq!(robot.decision(), None);
    robot.act("idle", 0.9);
    robot.run(300);
    assert_eq!(robot.decision().as_deref(), Some("request: wheel on the robot's side"));
}

#[test]
fn side_grip_means_a_handover_and_the_robot_prepares_to_receive() {
    let mut robot = start();
    robot.act("idle", 0.9);
    robot.run(300);
    robot.act("rest", 0.0);
    robot.act("idle", 0.0);
    robot.reaches_for("wheel", "side");
    robot.run(150);
    assert_eq!(robot.intention().as_deref(), Some("hand over: wheel on the robot's side"));
    assert_eq!(robot.decision().as_deref(), Some("receive: wheel on the robot's side"));
}

#[test]
fn received_part_is_inserted() {
    let mut robot = start();
    robot.act("rest", 0.0);
    robot.act("side grip: wheel", 1.0);
    robot.run(300);
    robot.robot_holds("wheel", 1.0);
    robot.run(300);
    robot.act("side grip: wheel", 0.0);
    robot.act("rest", 1.0);
    robot.run(300);
    assert_eq!(robot.decision().as_deref(), Some("insert: wheel on the robot's side"));
    robot.achieve(ROBOT_WHEEL);
    robot.robot_holds("wheel", 0.0);
    robot.run(300);
    assert_eq!(robot.decision().as_deref(), Some("insert: nut on the robot's side"));
}

#[test]
fn no_population_ignites_from_one_source_alone() {
    // For every act alone, and for the objects alone: the simulation layer stays silent for ever (5 s).
    let names: Vec<String> = {
        let robot = Harness::of("toy-vehicle");
        (0..robot.task().acts.len()).map(|act| robot.task().act_name(act)).collect()
    };
    for name in names {
        let mut robot = Harness::of("toy-vehicle");
        robot.act(&name, 1.0);
        robot.run(5000);
        assert_eq!(robot.simulation(), None, "{name} alone");
    }
    let mut robot = Harness::of("toy-vehicle");
    robot.lay_out();
    robot.run(5000);
    assert_eq!(robot.simulation(), None, "objects and plan alone");
}

#[test]
fn no_observation_leads_to_a_decision_without_the_person_and_no_stall() {
    // A part of the robot's own lies within its reach: it goes on alone while nothing is seen of the person.
    let mut robot = start();
    robot.achieve(ROBOT_WHEEL);
    robot.act("rest", 0.0);
    robot.run(300);
    assert_eq!(robot.decision().as_deref(), Some("insert: nut on the robot's side"));
}

#[test]
fn decision_layers_never_hold_two_peaks_whatever_the_evidence() {
    let mut robot = start();
    for step in 0..400_u64 {
        // A fixed, irregular sequence of evidence for all acts.
        for act in 0..robot.task().acts.len() {
            let value = (step * 7919 + act as u64 * 104_729) % 1000;
            robot.act_at(act, value as f64 / 1000.0);
        }
        robot.run(50);
        for layer in coact_fields_layers() {
            assert!(robot.peaks(layer).len() <= 1, "{layer:?} holds {:?}", robot.peaks(layer));
        }
    }
}

fn coact_fields_layers() -> [coact_messages::LayerKind; 4] {
    use coact_messages::LayerKind::{ActionExecution, ActionSimulation, ErrorMonitoring, Intention};
    [ActionSimulation, Intention, ErrorMonitoring, ActionExecution]
}
