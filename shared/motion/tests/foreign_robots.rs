//! Robots that only a URDF describes: planned for, or refused with one clear error.
#![allow(clippy::unwrap_used)]

use coact_motion::{Aim, Margin, Mechanism, Meshes, Problem, Scene};
use coact_robot::{HandGoal, MotionState, RobotError, Urdf};
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
    for finger in 0..fingers {
        let name = format!("finger_{finger}");
        link(&mut text, &name, "<box size=\"0.02 0.02 0.08\"/>");
        let at = [0.04 * finger as f64 - 0.02, 0.0, 0.12];
        joint(&mut text, &format!("{name}_joint"), [parent, &name], at, "1 0 0", "lower=\"0\" upper=\"1\"");
    }
    text + "</robot>"
}

const WIDE: &str = "lower=\"-2.8\" upper=\"2.8\"";
const BALL: &str = "<sphere radius=\"0.05\"/>";

fn load(text: String) -> Result<Mechanism, RobotError> {
    Mechanism::from_urdf(Urdf::parse(Path::new("six.urdf"), text)?, Meshes::Required)
}

#[test]
fn an_arm_without_closed_form_reaches_what_it_can_reach() {
    let mechanism = load(six_joints(WIDE, BALL, 2)).unwrap();
    assert!(mechanism.closed_form.is_none());
    let body = mechanism.body(&|_| 0.5).unwrap();
    for at in [[0.4, -0.8, 1.0, 0.3, 0.5, 0.2], [-0.6, 0.5, -1.2, 0.7, -0.4, 1.0]] {
        let mut posture = [0.0; 7];
        posture[..6].copy_from_slice(&at);
        let palm = mechanism.arm.palm(&posture);
        let goal = HandGoal {
            point: palm * mechanism.grasp_point(),
            approach: palm.rotation * Vector3::z(),
            closing: palm.rotation * Vector3::x(),
            rolls: 0,
            back: 0.0,
            floor: f64::NEG_INFINITY,
        };
        let problem = Problem {
            mechanism: &mechanism,
            body: &body,
            scene: &Scene::default(),
            start: mechanism.park.map(MotionState::at_rest),
            leave: None,
            aim: Aim::Hand(vec![goal]),
            then: Vec::new(),
            margin: Margin::default(),
        };
        let plan = problem.plan().unwrap();
        let reached = mechanism.arm.palm(&plan.end());
        assert!((reached * mechanism.grasp_point() - goal.point).norm() < 1e-3);
        assert!((reached.rotation * Vector3::z()).angle(&goal.approach) < 0.03);
        assert_eq!(plan.broken(&mechanism.limits()), None);
    }
}

#[test]
fn broken_robots_are_refused_with_the_place_and_the_reason() {
    let mesh = "<mesh filename=\"package://six/arm.stl\"/>";
    let cases = [
        (six_joints("lower=\"1\" upper=\"-1\"", BALL, 2), "lower < upper"),
        (six_joints("lower=\"0\" upper=\"0\"", BALL, 2), "lower < upper"),
        (six_joints(WIDE, mesh, 2), "package://six/arm.stl"),
        (six_joints(WIDE, BALL, 0), "expected a hand"),
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
    assert!(mechanism.body(&|_| 0.0).unwrap().bones().len() >= 8);
}
