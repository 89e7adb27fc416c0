use super::manipulator::{Fingers, Manipulator};
use super::{NOISE, config};
use coact_joint_task::{Agent, Subgoal};
use coact_robot::Robot;
use glam::DVec3;

const AT: [f64; 2] = [-0.40, 0.55];
pub(super) const KINDS: [&str; 4] = ["wheel", "nut", "column 3", "top floor"];

/// The place on the robot's side for the part.
pub(super) fn goal(robot: &Manipulator) -> Subgoal {
    let task = &robot.world.task;
    let own = |goal: &&Subgoal| goal.kind == robot.world.parts.kind(0) && goal.side == Agent::Robot;
    task.subgoals.iter().find(own).unwrap().clone()
}

#[test]
fn touch_of_a_held_part_has_no_gaps() {
    for kind in KINDS {
        let mut robot = Manipulator::holding(kind, 6);
        let goal = goal(&robot);
        let (before, _) = robot.reach(goal.socket.into(), goal.axis.into());
        let mut felt = (f64::INFINITY, 0.0_f64);
        robot.watch(&before, Fingers::Closed, |robot| {
            let touch = robot.out.sample.joints.touch;
            felt = (felt.0.min(touch), felt.1.max(touch));
        });
        assert!(robot.holds() && felt.0 > 1.0, "{kind}: from {} to {} N", felt.0, felt.1);
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
    assert!(robot.out.sample.joints.touch < NOISE);
    assert_eq!(robot.world.simulation.robot.slipped.get(), Some(0), "out of closed fingers");
}

#[test]
fn fingers_that_close_beside_a_part_hold_nothing() {
    let mut robot = Manipulator::new("column 3", AT);
    let table = robot.world.task.scene.table_height;
    robot.pick(DVec3::new(AT[0] + 0.2, AT[1], table), DVec3::Z);
    assert!(!robot.holds());
    assert!(robot.out.sample.joints.touch < NOISE);
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
