//! Robot descriptions: ours, others', and broken ones.
#![allow(clippy::unwrap_used)]

use coact_robot::{Arm, ArmEnd, NotSrs, Robot, Srs, Urdf};
use nalgebra::{Point3, Vector3};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn ours() -> (PathBuf, String) {
    let path = root().join("rt-config/robots/aros.urdf");
    let text = std::fs::read_to_string(&path).unwrap();
    (path, text)
}

/// A recorded URDF of another robot; says so when it is not there.
fn others(name: &str) -> Option<PathBuf> {
    let path = root().join("../shared/data/urdf").join(name);
    if !path.exists() {
        eprintln!("skipped: {} is not there", path.display());
        return None;
    }
    Some(path)
}

#[test]
fn a_urdf_that_is_nested_without_end_is_refused() {
    let text = format!("<robot name=\"a\">{}", "<link name=\"a\">".repeat(200_000));
    let error = Urdf::parse(Path::new("deep.urdf"), text).unwrap_err().to_string();
    assert!(error.starts_with("deep.urdf:1: is nested more than 32 deep"), "{error}");
}

proptest::proptest! {
    #[test]
    fn damage_anywhere_in_a_urdf_is_survived(
        at in proptest::prelude::any::<proptest::sample::Index>(),
        removed in 0_usize..300,
        inserted in "[<>/\"'= a-z0-9!?-]{0,20}",
    ) {
        let (path, mut text) = ours();
        let start = text.floor_char_boundary(at.index(text.len()));
        let end = text.floor_char_boundary((start + removed).min(text.len()));
        text.replace_range(start..end, &inserted);
        // That it returns is what is tested.
        if let Ok(urdf) = Urdf::parse(&path, text) {
            urdf.chain(None, "palm").ok();
        }
    }
}

/// The error that `text` gets after `from` was replaced by `to`, as the user sees it.
fn error_after(from: &str, to: &str) -> String {
    let (path, text) = ours();
    assert!(text.contains(from), "{from} is not in the URDF");
    match Urdf::parse(&path, text.replacen(from, to, 1)) {
        Err(error) => error.to_string(),
        Ok(urdf) => urdf.chain(None, "palm").unwrap_err().to_string(),
    }
}

#[test]
fn our_robot_has_seven_joints_and_three_fingers() {
    let robot = Robot::load(&root().join("rt-config/robots/aros.toml")).unwrap();
    assert_eq!(robot.name, "aros");
    let limits = robot.limits();
    assert_eq!((limits[0].lower, limits[0].upper, limits[0].effort), (-2.618, 1.571, 370.0));
    assert!(
        limits
            .iter()
            .all(|limit| limit.velocity == 2.0 && limit.acceleration.is_finite() && limit.jerk.is_finite())
    );
    assert!((robot.hand.coupling - 1.0 / 3.0).abs() < 1e-9);
    assert!(robot.arm().within_limits(&robot.park, 0.05));
}

#[test]
fn faults_name_file_line_and_what_was_expected() {
    let missing_limit =
        error_after("<limit lower=\"-2.618\" upper=\"1.571\" effort=\"370\" velocity=\"2\"/>", "");
    assert!(missing_limit.contains("aros.urdf:") && missing_limit.contains("arm_1"), "{missing_limit}");
    assert!(missing_limit.contains("limit"), "{missing_limit}");
    let reversed = error_after("lower=\"-1.658\" upper=\"0.785\"", "lower=\"0.785\" upper=\"-1.658\"");
    assert!(reversed.contains("arm_2") && reversed.contains("lower < upper"), "{reversed}");
    let prismatic = error_after("name=\"arm_3\" type=\"revolute\"", "name=\"arm_3\" type=\"prismatic\"");
    assert!(prismatic.contains("arm_3") && prismatic.contains("expected revolute or fixed"), "{prismatic}");
    let word = error_after("xyz=\"0 0 0.395\"", "xyz=\"0 0 long\"");
    assert!(word.contains("aros.urdf:"), "{word}");
    let open_tag = error_after("</link>", "");
    assert!(open_tag.contains("aros.urdf:"), "{open_tag}");
}

#[test]
fn the_line_is_that_of_the_faulty_joint() {
    let (_, text) = ours();
    let line = 1 + text.lines().position(|line| line.contains("name=\"arm_2\"")).unwrap();
    let error = error_after("lower=\"-1.658\"", "lower=\"5\"");
    assert!(error.contains(&format!("aros.urdf:{line}:")), "line {line}: {error}");
}

#[test]
fn a_missing_file_and_an_unknown_link_are_named() {
    let error = Urdf::load(Path::new("no/such.urdf")).unwrap_err().to_string();
    assert!(error.contains("no/such.urdf"), "{error}");
    let (path, text) = ours();
    let error = Urdf::parse(&path, text).unwrap().chain(None, "claw").unwrap_err().to_string();
    assert!(error.contains("claw"), "{error}");
}

#[test]
fn a_robot_file_with_a_wrong_key_is_refused_with_its_line() {
    let text = std::fs::read_to_string(root().join("rt-config/robots/aros.toml")).unwrap();
    let place = std::env::temp_dir().join(format!("coact-robot-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    let path = place.join("aros.toml");
    std::fs::copy(root().join("rt-config/robots/aros.urdf"), place.join("aros.urdf")).unwrap();
    for (from, to, word) in [
        ("palm = ", "plam = ", "plam"),
        ("joints = [\"arm_1\"", "joints = [\"arm_9\"", "joints"),
        ("park = [-2.39983", "park = [2.9", "park"),
        ("jerk = 2000.0", "jerk = -1.0", "jerk"),
    ] {
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let error = Robot::load(&path).unwrap_err().to_string();
        assert!(error.contains("aros.toml:") && error.contains(word), "{error}");
    }
    std::fs::remove_dir_all(&place).unwrap();
}

#[test]
fn another_arm_is_loaded_and_its_inverse_kinematics_found() {
    let Some(path) = others("schunk_lwa_sdh.urdf") else { return };
    let (joints, tool) = Urdf::load(&path).unwrap().chain(None, "sdh_palm_link").unwrap();
    assert_eq!(joints.len(), 7);
    let kinematics = Srs::new(Arm { joints, tool }).unwrap();
    let posture = [0.4, -0.7, 0.3, 1.1, -0.5, 0.8, 0.2];
    let palm = kinematics.arm().palm(&posture);
    let mut solutions = 0;
    for step in 0..72 {
        for solution in kinematics.solve(&palm, f64::from(step) * 5f64.to_radians(), 0.0).as_slice() {
            let found = kinematics.arm().palm(solution);
            // Its file rounds right angles to 1.5708.
            assert!((found.translation.vector - palm.translation.vector).norm() < 1e-4);
            solutions += 1;
        }
    }
    assert!(solutions > 0);
}

#[test]
fn another_hand_is_loaded_finger_by_finger() {
    let Some(path) = others("bh282.urdf") else { return };
    let urdf = Urdf::load(&path).unwrap();
    let last = urdf.links().iter().rfind(|link| link.name.contains("finger_3")).unwrap().name.clone();
    let (joints, _) = urdf.chain(None, &last).unwrap();
    assert!(joints.len() == 2, "base and tip: {joints:?}");
}

#[test]
fn an_arm_of_another_build_has_no_such_kinematics() {
    let (path, text) = ours();
    let bent = text.replacen("<axis xyz=\"0 -1 0\"/>", "<axis xyz=\"0 -1 0.2\"/>", 1);
    let (joints, tool) = Urdf::parse(&path, bent).unwrap().chain(None, "palm").unwrap();
    let NotSrs(reason) = Srs::new(Arm { joints, tool }).unwrap_err();
    assert!(reason.contains("axis"), "{reason}");
}

/// Torque about each arm joint that gravity asks for, Nm, with `load` kg at the grasp point.
fn gravity_torques(robot: &Robot, urdf: &Urdf, posture: &[f64; 7], load: f64) -> [f64; 7] {
    let mut masses: Vec<(f64, Point3<f64>, usize)> = Vec::new();
    for link in urdf.links() {
        let Ok((joints, fixed)) = urdf.chain(None, &link.name) else { continue };
        let angles: Vec<f64> =
            (0..joints.len()).map(|index| posture.get(index).copied().unwrap_or(0.8)).collect();
        let count = joints.len();
        let pose = Arm { joints, tool: fixed }.palm(&angles);
        let centre = Point3::from(Vector3::from(link.inertial.origin.xyz.0));
        masses.push((link.inertial.mass.value, pose * centre, count));
    }
    masses.push((load, robot.grasp_point(posture), 7));
    std::array::from_fn(|joint| {
        let frame = robot.arm().frame(posture, joint);
        let axis = frame.rotation * robot.arm().joints[joint].axis.into_inner();
        let beyond = masses.iter().filter(|(_, _, joints)| *joints > joint);
        beyond
            .map(|(mass, at, _)| {
                let arm = at.coords - frame.translation.vector;
                arm.cross(&Vector3::new(0.0, 0.0, -9.81 * mass)).dot(&axis).abs()
            })
            .sum()
    })
}

#[test]
fn the_motors_carry_arm_hand_and_part_at_full_reach() {
    let robot = Robot::load(&root().join("rt-config/robots/aros.toml")).unwrap();
    let (path, text) = ours();
    let urdf = Urdf::parse(&path, text).unwrap();
    let mut largest = [0.0f64; 7];
    // The straight arm is horizontal; turning it about itself puts each axis across gravity in turn.
    for step in 0..16 {
        let turn = f64::from(step) * std::f64::consts::FRAC_PI_8;
        for posture in
            [[turn - 2.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [-1.5, 0.0, 0.0, 0.0, turn - 2.8, -1.5, 1.5]]
        {
            let torques = gravity_torques(&robot, &urdf, &posture, 0.25);
            for joint in 0..7 {
                largest[joint] = largest[joint].max(torques[joint]);
            }
        }
    }
    for (joint, torque) in largest.iter().enumerate() {
        let effort = robot.limits()[joint].effort;
        assert!(*torque < 0.7 * effort, "joint {}: {torque:.1} Nm of {effort}", joint + 1);
    }
    assert!(largest[1] > 20.0, "the test moves a real load: {largest:?}");
}

/// A hand of two fingers whose links are called as those of our robot.
fn gripper(limits: &str) -> Urdf {
    let finger = |name: &str, y: f64| {
        format!(
            "<link name=\"{name}\"/>\n<joint name=\"{name}_joint\" type=\"revolute\"><origin xyz=\"0 {y} 0.05\"/>\
             <parent link=\"palm\"/><child link=\"{name}\"/><axis xyz=\"1 0 0\"/>\n<limit {limits} effort=\"5\" \
             velocity=\"2\"/></joint>\n"
        )
    };
    let links = "<link name=\"world\"/>\n<link name=\"palm\"/>\n<joint name=\"mount\" type=\"fixed\">\
                 <origin xyz=\"0 0 0.01\"/><parent link=\"world\"/><child link=\"palm\"/></joint>\n";
    let fingers = finger("left", 0.04) + &finger("right", -0.04);
    Urdf::parse(Path::new("gripper.urdf"), format!("<robot name=\"gripper\">\n{links}{fingers}</robot>"))
        .unwrap()
}

#[test]
fn another_hand_stands_where_ours_stood() {
    let (path, text) = ours();
    let ours = Urdf::parse(&path, text).unwrap();
    let robot = ours.with_hand(&gripper("lower=\"0\" upper=\"1\"")).unwrap();
    assert_eq!(robot.palm().unwrap(), "gripper/palm");
    let (_, before) = ours.chain(None, "palm").unwrap();
    let (joints, after) = robot.chain(None, "gripper/palm").unwrap();
    assert_eq!(joints.len(), 7);
    assert!(
        (before.inverse() * after).translation.vector.metric_distance(&Vector3::new(0.0, 0.0, 0.01)) < 1e-9
    );
    assert!(robot.chain(None, "gripper/left").unwrap().0.len() == 8);
    assert!(!robot.links().iter().any(|link| link.name == "palm" || link.name.starts_with("finger")));
}

#[test]
fn a_hand_is_mounted_on_an_arm_that_has_none() {
    let (path, text) = ours();
    let cut = text.find("<link name=\"palm\">").unwrap();
    let bare = Urdf::parse(&path, text[..cut].to_owned() + "</robot>").unwrap();
    assert_eq!(bare.arm_end().unwrap(), ArmEnd::Bare("wrist_roll".into()));
    assert!(bare.palm().unwrap_err().to_string().contains("--hand"));
    let robot = bare.with_hand(&gripper("lower=\"0\" upper=\"1\"")).unwrap();
    assert_eq!(robot.palm().unwrap(), "gripper/palm");
    assert_eq!(robot.chain(None, "gripper/right").unwrap().0.len(), 8);
    assert!(robot.links().iter().any(|link| link.name == "wrist_roll"));
}

#[test]
fn faults_of_a_mounted_hand_name_its_own_file_and_line() {
    let (path, text) = ours();
    let ours = Urdf::parse(&path, text).unwrap();
    for limits in ["lower=\"1\" upper=\"0\"", "lower=\"0\" upper=\"0\""] {
        let robot = ours.with_hand(&gripper(limits)).unwrap();
        let error = robot.chain(None, "gripper/left").unwrap_err().to_string();
        assert!(error.starts_with("gripper.urdf:6:") && error.contains("lower < upper"), "{error}");
    }
}

#[test]
fn what_has_no_fingers_is_no_hand() {
    let (path, text) = ours();
    let ours = Urdf::parse(&path, text).unwrap();
    let stick = "<robot name=\"stick\"><link name=\"stick\"/></robot>".to_owned();
    let stick = Urdf::parse(Path::new("stick.urdf"), stick).unwrap();
    let error = ours.with_hand(&stick).unwrap_err().to_string();
    assert!(error.starts_with("stick.urdf:1:") && error.contains("no fingers branch off"), "{error}");
}

#[test]
fn a_real_hand_is_mounted_on_our_arm() {
    let Some(file) = others("bh282.urdf") else { return };
    let (path, text) = ours();
    let robot = Urdf::parse(&path, text).unwrap().with_hand(&Urdf::load(&file).unwrap()).unwrap();
    assert_eq!(robot.palm().unwrap(), "bh282/bh_base_link");
    assert_eq!(robot.chain(None, "bh282/bh_finger_13_link").unwrap().0.len(), 10);
    assert_eq!(robot.path_of("bh282/bh_finger_13_link"), file);
    assert_eq!(robot.path_of("wrist_roll"), path);
    let (mimicked, ..) = robot.mimicked("bh282/bh_j13_joint").unwrap();
    assert_eq!(mimicked, "bh282/bh_j12_joint");
}
