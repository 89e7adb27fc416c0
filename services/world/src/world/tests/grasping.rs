use super::config;
use super::manipulator::{Fingers, Manipulator};
use crate::parts::Holder;
use coact_joint_task::{Agent, Subgoal};
use coact_robot::Robot;
use glam::{DQuat, DVec3};

const AT: [f64; 2] = [-0.40, 0.55];
const KINDS: [&str; 4] = ["wheel", "nut", "column 3", "top floor"];

/// The place on the robot's side for the part.
fn goal(robot: &Manipulator) -> Subgoal {
    let task = &robot.world.task;
    let own = |goal: &&Subgoal| goal.kind == robot.world.parts.kind(0) && goal.side == Agent::Robot;
    task.subgoals.iter().find(own).unwrap().clone()
}

/// Slip of the part in the hand over a movement to before its socket: m and degrees; none when it was lost.
fn slip(kind: &str, seed: u64) -> Option<(f64, f64)> {
    let mut robot = Manipulator::holding(kind, seed);
    let (lifted, goal) = (robot.in_hand(), goal(&robot));
    let (before, _) = robot.reach(goal.socket.into(), goal.axis.into());
    robot.go(&before, Fingers::Closed);
    robot.stay(100);
    robot.holds().then(|| robot.in_hand().since(&lifted))
}

#[test]
fn parts_stay_in_the_hand_where_they_were_grasped() {
    for kind in KINDS {
        let (way, angle) = slip(kind, 1).unwrap_or_else(|| panic!("{kind} was lost"));
        assert!(way < 0.002 && angle < 3.0, "{kind} slipped by {way} m, {angle} degrees");
    }
}

/// `cargo test -p coact-world --release twenty_grasps -- --ignored --nocapture`
#[test]
#[ignore = "takes minutes, and tells figures"]
fn twenty_grasps_measured() {
    for kind in KINDS {
        let slips: Vec<_> = (0..20).filter_map(|seed| slip(kind, seed)).collect();
        let most =
            slips.iter().fold((0.0, 0.0), |most: (f64, f64), slip| (most.0.max(slip.0), most.1.max(slip.1)));
        let mean = slips.iter().fold((0.0, 0.0), |sum, slip| (sum.0 + slip.0, sum.1 + slip.1));
        let count = slips.len() as f64;
        println!(
            "{kind}: held {} of 20, slip at most {:.2} mm {:.2} degrees, on average {:.2} mm {:.2} degrees",
            slips.len(),
            1e3 * most.0,
            most.1,
            1e3 * mean.0 / count,
            mean.1 / count
        );
    }
}

#[test]
fn part_is_mounted_within_the_tolerances_and_not_outside() {
    for (aside, tilt, mounted) in [(0.5, 0.0, true), (2.0, 0.0, false), (0.0, 0.5, true), (0.0, 3.0, false)] {
        let mut robot = Manipulator::holding("column 3", 3);
        let (goal, fit) = (goal(&robot), robot.world.task.scene.fit);
        let turn = DQuat::from_axis_angle(DVec3::Y, tilt * fit.angle);
        let place = DVec3::from(goal.socket) + DVec3::new(0.0, aside * fit.position, 0.0);
        robot.put(place, turn * DVec3::from(goal.axis));
        let what = format!("{aside} x the distance, {tilt} x the angle");
        assert_eq!(robot.world.parts.is(0, Holder::Socket), mounted, "{what}");
        assert!(!robot.holds(), "{what}");
    }
}

#[test]
fn part_that_is_pulled_away_is_lost_and_no_longer_felt() {
    let mut robot = Manipulator::holding("column 3", 5);
    robot.pull(DVec3::new(0.0, 0.0, -2.0));
    robot.stay(500);
    assert!(robot.holds() && robot.out.sample.joints.touch > 1.0, "a weak pull is withstood");
    robot.pull(DVec3::new(0.0, 0.0, -80.0));
    robot.stay(500);
    assert!(!robot.holds());
    assert_eq!(robot.out.sample.joints.touch, 0.0);
}

#[test]
fn fingers_that_close_beside_a_part_hold_nothing() {
    let mut robot = Manipulator::new("column 3", AT);
    let table = robot.world.task.scene.table_height;
    robot.pick(DVec3::new(AT[0] + 0.2, AT[1], table));
    assert!(!robot.holds());
    assert_eq!(robot.out.sample.joints.touch, 0.0);
}

#[test]
fn held_part_stays_held_when_the_world_is_killed() {
    for kind in KINDS {
        let mut robot = Manipulator::holding(kind, 2);
        let before = robot.in_hand();
        robot.kill();
        robot.stay(500);
        let (way, angle) = robot.in_hand().since(&before);
        assert!(robot.holds() && way < 0.003, "{kind}: {way} m, {angle} degrees");
    }
}

#[test]
fn arm_follows_with_a_part_and_sinks_when_its_motors_are_too_weak() {
    assert!(Manipulator::holding("column 3", 4).deviation < 0.01);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("aros.toml");
    std::fs::copy(config("robots/aros.toml"), &file).unwrap();
    let urdf = std::fs::read_to_string(config("robots/aros.urdf")).unwrap();
    let weak = urdf.replace("effort=\"370\"", "effort=\"20\"");
    std::fs::write(folder.path().join("aros.urdf"), weak).unwrap();
    let mut robot = Manipulator::with(Robot::load(&file).unwrap(), "column 3", AT);
    let table = robot.world.task.scene.table_height;
    let (stretched, _) = robot.reach(DVec3::new(AT[0] - 0.15, AT[1] - 0.1, table), DVec3::Z);
    robot.go(&stretched, Fingers::Open);
    robot.stay(500);
    assert!(robot.deviation > 0.05, "sank by {} rad", robot.deviation);
}
