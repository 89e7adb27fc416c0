//! Robots that only a URDF describes: planned for, or refused with one clear error.
#![allow(clippy::unwrap_used)]

use coact_motion::{Goal, Mechanism, Meshes, Problem, Scene};
use coact_robot::{HandGoal, MotionState, Posture, Robot, RobotError, Urdf};
use nalgebra::Vector3;
use std::fmt::Write;
use std::path::Path;

/// An arm of six joints whose wrist axes do not meet, as industrial arms have it (lengths in m), with two fingers.
const ARM: [(&str, [f64; 3], &str); 6] = [
    ("base", [0.0, 0.0, 0.15], "0 0 1"),
    ("shoulder", [0.0, 0.12, 0.0], "0 1 0"),
    ("elbow", [0.0, -0.1, 0.42], "0 1 0"),
    ("wrist_1", [0.0, 0.0, 0.39], "0 1 0"),
    ("wrist_2", [0.0, 0.09, 0.0], "0 0 1"),
    ("wrist_3", [0.0, 0.0, 0.09], "0 1 0"),
];

fn link(text: &mut String, name: &str, geometry: &str) {
    let shape = format!("<geometry>{geometry}</geometry>");
    writeln!(text, "<link name=\"{name}\"><collision>{shape}</collision></link>").unwrap();
}

fn joint(
    text: &mut String,
    name: &str,
    [parent, child]: [&str; 2],
    [x, y, z]: [f64; 3],
    axis: &str,
    limits: &str,
) {
    writeln!(
        text,
        "<joint name=\"{name}\" type=\"revolute\"><origin xyz=\"{x} {y} {z}\"/><parent link=\"{parent}\"/>\
         <child link=\"{child}\"/><axis xyz=\"{axis}\"/><limit {limits} effort=\"50\" velocity=\"2\"/></joint>"
    )
    .unwrap();
}

fn six_joints(limits: &str, geometry: &str, fingers: usize) -> String {
    let mut text = "<robot name=\"six\">\n".to_owned();
    link(&mut text, "root", "<box size=\"0.1 0.1 0.1\"/>");
    let mut parent = "root";
    for (name, at, axis) in ARM {
        link(&mut text, name, geometry);
        joint(&mut text, &format!("{name}_joint"), [parent, name], at, axis, limits);
        parent = name;
    }
    self::fingers(&mut text, parent, fingers);
    text + "</robot>"
}

/// A hand alone, with a palm of this form.
fn hand(geometry: &str) -> String {
    let mut text = "<robot name=\"hand\">\n".to_owned();
    link(&mut text, "wrist", geometry);
    fingers(&mut text, "wrist", 2);
    text + "</robot>"
}

fn fingers(text: &mut String, palm: &str, count: usize) {
    for finger in 0..count {
        let name = format!("finger_{finger}");
        link(text, &name, "<box size=\"0.02 0.02 0.08\"/>");
        let at = [0.04 * finger as f64 - 0.02, 0.0, 0.12];
        joint(text, &format!("{name}_joint"), [palm, &name], at, "1 0 0", "lower=\"0\" upper=\"1\"");
    }
}

const WIDE: &str = "lower=\"-2.8\" upper=\"2.8\"";
const BALL: &str = "<sphere radius=\"0.05\"/>";

fn load(text: String) -> Result<Mechanism, RobotError> {
    Mechanism::from_urdf(Urdf::parse(Path::new("six.urdf"), text)?, Meshes::Required)
}

/// Plans from the middle of all joint ranges to where the hand is at this posture.
fn is_reached(mechanism: &Mechanism, posture: &Posture) {
    let collision_model = mechanism.collision_model(&|_| 0.5).unwrap();
    let palm = mechanism.arm.palm(posture);
    let goal = HandGoal {
        point: palm * mechanism.grasp_point(),
        approach: palm.rotation * Vector3::z(),
        closing_axis: palm.rotation * Vector3::x(),
        rolls: 0,
        along: palm.rotation * Vector3::z(),
        back: 0.0,
        floor: f64::NEG_INFINITY,
    };
    let (scene, start) = (Scene::default(), mechanism.park.map(MotionState::at_rest));
    let problem = Problem::new(mechanism, &collision_model, &scene, start, Goal::Hand(vec![goal]));
    let plan = problem.plan().unwrap();
    let reached = mechanism.arm.palm(&plan.end());
    assert!((reached * mechanism.grasp_point() - goal.point).norm() < 1e-3);
    assert!((reached.rotation * Vector3::z()).angle(&goal.approach) < 0.03);
    assert_eq!(plan.broken(&mechanism.limits()), None);
}

#[test]
fn an_arm_without_closed_form_reaches_what_it_can_reach() {
    let mechanism = load(six_joints(WIDE, BALL, 2)).unwrap();
    assert!(mechanism.closed_form.is_none());
    is_reached(&mechanism, &[0.4, -0.8, 1.0, 0.3, 0.5, 0.2, 0.0]);
    is_reached(&mechanism, &[-0.6, 0.5, -1.2, 0.7, -0.4, 1.0, 0.0]);
}

#[test]
fn our_arm_moves_with_another_hand() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let robot = Robot::load(&root.join("../../rt-config/robots/aros.toml")).unwrap();
    let ours = Mechanism::of(&robot).unwrap();
    let hand = Urdf::parse(Path::new("hand.urdf"), hand(BALL)).unwrap();
    let mechanism = ours.clone().with_hand(&hand, Meshes::Required).unwrap();
    assert!(mechanism.closed_form.is_some());
    assert_eq!(mechanism.limits(), ours.limits());
    let names: Vec<_> =
        mechanism.collision_model(&|_| 0.0).unwrap().links().iter().map(|link| link.name.clone()).collect();
    assert!(
        names.iter().any(|name| name == "hand/finger_1") && names.iter().all(|name| name != "palm"),
        "{names:?}"
    );
    let mut posture = robot.park;
    posture.iter_mut().for_each(|angle| *angle *= 0.6);
    is_reached(&mechanism, &posture);
}

#[test]
fn a_hand_alone_is_refused_with_what_to_do_about_it() {
    let error = load(hand(BALL)).unwrap_err().to_string();
    assert!(error.starts_with("six.urdf:2:") && error.contains("--hand"), "{error}");
}

#[test]
fn a_mesh_that_a_mounted_hand_lacks_is_said_to_be_the_hands() {
    let arm = Urdf::parse(Path::new("six.urdf"), six_joints(WIDE, BALL, 0)).unwrap();
    let hand = Urdf::parse(Path::new("hand.urdf"), hand("<mesh filename=\"knuckle.stl\"/>")).unwrap();
    let urdf = arm.with_hand(&hand).unwrap();
    let error = Mechanism::from_urdf(urdf.clone(), Meshes::Required).unwrap_err().to_string();
    assert!(error.starts_with("hand.urdf:2:") && error.contains("knuckle.stl"), "{error}");
    assert!(Mechanism::from_urdf(urdf, Meshes::OrCapsules(0.05)).is_ok());
}

#[test]
fn broken_robots_are_refused_with_the_place_and_the_reason() {
    let mesh = "<mesh filename=\"package://six/arm.stl\"/>";
    let cases = [
        (six_joints("lower=\"1\" upper=\"-1\"", BALL, 2), "lower < upper"),
        (six_joints("lower=\"0\" upper=\"0\"", BALL, 2), "lower < upper"),
        (six_joints(WIDE, mesh, 2), "package://six/arm.stl"),
        (six_joints(WIDE, BALL, 0), "expected a hand"),
        (six_joints(WIDE, "<box size=\"0.1 0.1 -inf\"/>", 2), "expected all sides above 0"),
        (six_joints(WIDE, "<cylinder radius=\"0\" length=\"1\"/>", 2), "expected radius and length above 0"),
        (six_joints(WIDE, "<sphere radius=\"1e30\"/>", 2), "expected its radius above 0 and up to 100 m"),
        (six_joints(WIDE, BALL, 2).replace("</robot>", ""), "not a URDF"),
    ];
    for (text, reason) in cases {
        let error = load(text).unwrap_err().to_string();
        assert!(error.starts_with("six.urdf"), "{error}");
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn capsules_stand_in_for_missing_meshes_when_that_is_asked_for() {
    let text = six_joints(WIDE, "<mesh filename=\"arm.stl\"/>", 2);
    let urdf = Urdf::parse(Path::new("six.urdf"), text).unwrap();
    let mechanism = Mechanism::from_urdf(urdf, Meshes::OrCapsules(0.05)).unwrap();
    assert!(mechanism.collision_model(&|_| 0.0).unwrap().links().len() >= 8);
}
