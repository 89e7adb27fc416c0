//! Each motor skill is carried out, within the limits and in times that a person would take.
#![allow(clippy::unwrap_used)]

use crate::kinematic_world::{self, Holder, KinematicWorld};
use coact_control::PlannerDelay;
use coact_joint_task::ActionType;
use coact_messages::{Command, MotionPhase, NONE, ROBOT};
use nalgebra::{Isometry3, Point3, Vector3};
use std::time::Duration;

const NUT: &str = "nut on the robot's side";
const WHEEL: &str = "wheel on the robot's side";
const COLUMN_3: &str = "column 3 in its hole";
const COLUMN_2: &str = "column 2 in its hole";

/// Gives the robot a part of this subgoal's kind, free in its workspace.
fn lay_down(world: &mut KinematicWorld, subgoal: &str) -> usize {
    let kind = world.task.subgoals.iter().find(|goal| goal.name == subgoal).unwrap().kind;
    let index = world.parts.iter().position(|part| part.kind == kind).unwrap();
    if world.parts[index].workspace != ROBOT {
        world.parts[index].workspace = ROBOT;
        let places = [[-0.30, 0.46], [-0.40, 0.76], [-0.30, 0.74], [-0.46, 0.46]];
        let far = |at: &&[f64; 2]| {
            let others = world.parts.iter().map(|part| part.frame.translation.vector);
            others.map(|other| (other.x - at[0]).hypot(other.y - at[1])).all(|gap| gap > 0.1)
        };
        let [x, y] = places.iter().find(far).unwrap();
        world.parts[index].frame = Isometry3::translation(*x, *y, world.task.scene.table_height);
    }
    index
}

/// Height of the lowest of elbow, wrist and palm centre over the table.
fn clearance(world: &KinematicWorld) -> f64 {
    let centres = world.robot.arm().centres(&world.command.position);
    let palm = world.palm().translation.vector.z;
    centres[1..].iter().map(|centre| centre.z).fold(palm, f64::min) - world.task.scene.table_height
}

#[test]
fn every_part_of_the_robots_side_is_inserted() {
    let goals: Vec<String> = world_goals();
    for name in goals {
        let mut world = KinematicWorld::new();
        lay_down(&mut world, &name);
        let goal = world.task.subgoals.iter().position(|goal| goal.name == name).unwrap();
        let action = world.action(ActionType::Insert, &name);
        world.run(0.1);
        world.decide(Some(action));
        let mut lowest = f64::INFINITY;
        let taken = world.until(3.5, "taken", |world| {
            lowest = lowest.min(clearance(world));
            world.held().is_some()
        });
        let reach = world.phases.iter().find(|phase| phase.0 == MotionPhase::Approach).unwrap().1
            - world.phases.iter().find(|phase| phase.0 == MotionPhase::Reach).unwrap().1;
        println!("{name} palm z {:.2?} reach {reach}", world.palm().rotation * Vector3::z());
        let mounted = world.until(25.0, "mounted", |world| {
            if world.tick % 250 == 0 {
                println!(
                    "{} {:?} palm {:.3?} held {:.3?}",
                    world.tick,
                    world.phase(),
                    world.palm().translation.vector,
                    world.held().map(|p| p.frame.translation.vector)
                );
            }
            lowest = lowest.min(clearance(world));
            world.parts.iter().any(|part| part.holder == Holder::Socket(goal))
        });
        world.until(4.0, "parked", |world| world.phase() == MotionPhase::Rest && world.held().is_none());
        assert!((500..2200).contains(&reach), "{name}: reach took {reach} ms");
        assert!((2.0..5.5).contains(&(taken + mounted)), "{name}: {taken} + {mounted} s");
        assert!(lowest > 0.04, "{name}: {lowest} m above the table");
        assert!(world.used.iter().all(|used| *used > 0.3), "movements are not sluggish: {:?}", world.used);
        world.run(3.0);
        assert!(world.held().is_none(), "it is not taken out again");
    }
}

fn world_goals() -> Vec<String> {
    let task = kinematic_world::task();
    let inserts = task.actions.iter().filter(|action| action.action_type == ActionType::Insert);
    inserts.map(|action| task.subgoals[action.subgoal.unwrap()].name.clone()).collect()
}

#[test]
fn phases_of_an_insertion_come_in_order() {
    use MotionPhase::*;
    let mut world = KinematicWorld::new();
    world.run(0.05);
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(8.0, "mounted", |world| {
        world.parts.iter().any(|part| matches!(part.holder, Holder::Socket(_)))
    });
    world.until(4.0, "at rest", |world| world.phase() == Rest);
    let phases: Vec<_> = world.phases.iter().map(|phase| phase.0).collect();
    assert_eq!(phases, [Rest, Reach, Approach, Grasp, Transport, Approach, Release, Retreat, Rest]);
    assert_eq!(world.command.action, NONE);
}

/// The hand is beside it already, and sees what it closes on no more: nothing is waited for once the fingers have closed and feel it.
#[test]
fn a_grasp_takes_hardly_longer_than_the_fingers_do() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(6.0, "taken", |world| world.phase() == MotionPhase::Transport);
    let [.., (MotionPhase::Grasp, from), (MotionPhase::Transport, to)] = world.phases[..] else {
        panic!("{:?}", world.phases)
    };
    assert!(to - from < 300, "{} ms", to - from);
}

#[test]
fn without_the_part_in_sight_the_robot_does_not_reach() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, WHEEL)));
    world.run(2.0);
    assert_eq!(world.phases.iter().map(|phase| phase.0).collect::<Vec<_>>(), [MotionPhase::Rest]);
}

#[test]
fn a_request_holds_the_open_hand_out_to_the_person() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Request, WHEEL)));
    let time = world.until(4.0, "held out", |world| world.phase() == MotionPhase::Dwell);
    assert!((0.6..2.5).contains(&time), "{time} s");
    let short = (world.grasp_point() - Point3::from(world.task.scene.handover)).norm();
    assert!((0.15..0.25).contains(&short), "shown where the person's hand has room: {short} m short of it");
    assert!(world.robot.hand.width(world.command.position[8]) > 0.08, "open for it");
    world.run(2.0);
    assert_eq!(world.phase(), MotionPhase::Dwell);
    let held_out = world.palm();
    world.decide(Some(world.action(ActionType::Receive, WHEEL)));
    world.run(0.3);
    assert_eq!(world.phase(), MotionPhase::Dwell);
    let moved = (world.palm().translation.vector - held_out.translation.vector).norm();
    assert!(moved < 1e-6, "it receives from where it requests: {moved} m");
}

#[test]
fn a_request_that_nobody_answers_is_made_again_after_a_look_at_what_the_hand_has_hidden() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Request, WHEEL)));
    world.until(4.0, "held out", |world| world.phase() == MotionPhase::Dwell);
    world.until(11.0, "taken back", |world| world.phase() != MotionPhase::Dwell);
    let place = Point3::from(world.task.scene.handover);
    world.until(2.0, "out of the way", |world| (world.grasp_point() - place).norm() > 0.25);
    world.until(5.0, "held out again", |world| world.phase() == MotionPhase::Dwell);
}

/// The person holds a part of the wheel's kind, at the handover place.
fn hold_out(world: &mut KinematicWorld) -> usize {
    let kind = world.task.subgoals.iter().find(|goal| goal.name == WHEEL).unwrap().kind;
    let part = world.parts.iter().position(|part| part.kind == kind).unwrap();
    let [x, y, z] = world.task.scene.handover;
    world.parts[part].holder = Holder::Person;
    world.parts[part].frame = Isometry3::translation(x, y, z);
    world.hand_at([x - 0.15, y, z]);
    part
}

#[test]
fn a_part_is_received_and_inserted() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Receive, WHEEL)));
    world.until(4.0, "ready", |world| world.phase() == MotionPhase::Dwell);
    world.run(1.0);
    assert_eq!(world.phase(), MotionPhase::Dwell, "waits for the person");
    let part = hold_out(&mut world);
    let time = world.until(3.0, "received", |world| world.held().is_some());
    assert!(time < 1.5, "{time} s");
    world.run(0.3);
    world.hand_at(world.task.scene.person_rest);
    world.decide(Some(world.action(ActionType::Insert, WHEEL)));
    world.until(6.0, "mounted", |world| matches!(world.parts[part].holder, Holder::Socket(_)));
}

#[test]
fn an_empty_offer_is_noticed_and_the_robot_waits_again() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Receive, WHEEL)));
    world.until(4.0, "ready", |world| world.phase() == MotionPhase::Dwell);
    let part = hold_out(&mut world);
    world.until(2.0, "approach", |world| world.phase() == MotionPhase::Approach);
    world.parts[part].frame.translation.vector.x -= 0.2;
    world.hand_at(world.task.scene.person_rest);
    world.until(3.0, "felt nothing", |world| world.phase() == MotionPhase::Release);
    world.until(3.0, "waits", |world| world.phase() == MotionPhase::Dwell);
    hold_out(&mut world);
    world.until(3.0, "received", |world| world.held().is_some());
}

#[test]
fn a_part_is_given_and_let_go_only_when_the_person_has_it() {
    let mut world = KinematicWorld::new();
    let part = lay_down(&mut world, COLUMN_2);
    world.decide(Some(world.action(ActionType::Give, COLUMN_2)));
    world.until(8.0, "held out", |world| world.held().is_some() && world.phase() == MotionPhase::Dwell);
    let place = world.parts[part].frame.translation.vector;
    assert!((place - Vector3::from(world.task.scene.handover)).norm() < 0.01, "{place}");
    let [x, y, z] = world.task.scene.handover;
    world.hand_at([x - 0.15, y, z]);
    world.run(1.5);
    assert!(world.held().is_some(), "nobody has pulled at it");
    world.pull([-0.2, 0.0, 0.0]);
    world.run(0.5);
    assert!(world.held().is_some(), "that was hardly a touch");
    world.pull([-3.0, 0.0, 0.0]);
    let time = world.until(2.0, "given", |world| world.parts[part].holder == Holder::Person);
    assert!((0.03..0.6).contains(&time), "{time} s");
    world.until(5.0, "at rest", |world| world.phase() == MotionPhase::Rest);
}

#[test]
fn a_part_that_the_person_lets_go_of_first_is_held_again() {
    let mut world = KinematicWorld::new();
    lay_down(&mut world, COLUMN_2);
    world.decide(Some(world.action(ActionType::Give, COLUMN_2)));
    world.until(8.0, "held out", |world| world.held().is_some() && world.phase() == MotionPhase::Dwell);
    let [x, y, z] = world.task.scene.handover;
    world.hand_at([x - 0.15, y, z]);
    world.pull([-3.0, 0.0, 0.0]);
    world.until(1.0, "opens", |world| world.phase() == MotionPhase::Release);
    world.pull([0.0; 3]);
    world.until(1.0, "holds out again", |world| world.phase() == MotionPhase::Dwell);
    world.run(1.0);
    assert!(world.held().is_some(), "it has not dropped");
}

#[test]
fn a_hand_that_holds_something_else_is_given_nothing() {
    let mut world = KinematicWorld::new();
    lay_down(&mut world, COLUMN_2);
    world.decide(Some(world.action(ActionType::Give, COLUMN_2)));
    world.until(8.0, "held out", |world| world.held().is_some() && world.phase() == MotionPhase::Dwell);
    hold_out(&mut world);
    world.pull([-3.0, 0.0, 0.0]);
    world.run(2.0);
    assert!(world.held().is_some(), "the hand at the handover place is full");
}

#[test]
fn a_part_is_given_where_the_person_comes_to_meet_the_hand() {
    let mut world = KinematicWorld::new();
    let part = lay_down(&mut world, COLUMN_2);
    world.decide(Some(world.action(ActionType::Give, COLUMN_2)));
    world.until(8.0, "taken", |world| world.held().is_some());
    // The person's hand comes to where the robot's would begin its approach.
    let [x, y, z] = world.task.scene.handover;
    world.hand_at([x, y, z + 0.20]);
    world.run(6.0);
    assert!(world.held().is_some() && world.phase() == MotionPhase::Transport, "{:?}", world.phases);
    world.pull([-3.0, 0.0, 0.0]);
    world.until(1.0, "let go", |world| world.phase() == MotionPhase::Release);
    let place = world.grasp_point();
    world.until(1.0, "given", |world| world.parts[part].holder == Holder::Person);
    assert!((world.grasp_point() - place).norm() < 1e-3, "the hand that opens stays where it is");
}

/// The robot carries a part to its place, and the person's hand comes in the way, or stays away; what the wrist feels then.
fn carries_past_the_person(comes: bool, pull: f64) -> (KinematicWorld, usize) {
    let mut world = KinematicWorld::new();
    lay_down(&mut world, NUT);
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(8.0, "carried", |world| world.held().is_some() && world.phase() == MotionPhase::Transport);
    let part = world.parts.iter().position(|part| part.holder == Holder::Robot).unwrap();
    world.run(0.2);
    if comes {
        let goal = world.task.subgoals.iter().find(|goal| goal.name == NUT).unwrap();
        let here = world.grasp_point();
        let ahead = here + 0.08 * (Point3::from(goal.socket) - here).normalize();
        world.fingers_at(ahead.into());
    }
    world.pull([-pull, 0.0, 0.0]);
    (world, part)
}

#[test]
fn a_part_on_which_the_person_insists_is_let_go_whatever_it_is_for() {
    let (mut world, part) = carries_past_the_person(true, 3.0);
    world.until(3.0, "has it", |world| world.parts[part].holder == Holder::Person);
    // It is hers: nothing of it is mounted by the robot meanwhile.
    world.pull([0.0; 3]);
    world.run(1.0);
    assert!(world.held().is_none());
    for (comes, pull) in [(true, 0.5), (false, 3.0)] {
        let (mut world, _) = carries_past_the_person(comes, pull);
        world.run(0.8);
        assert!(world.held().is_some(), "her hand comes: {comes}, {pull} N");
    }
}

#[test]
fn the_base_is_steadied_until_the_decision_ends() {
    let mut world = KinematicWorld::new();
    let action = (0..world.task.actions.len())
        .find(|index| world.task.actions[*index].action_type == ActionType::Steady);
    world.decide(action.map(|action| action as u32));
    world.until(4.0, "steadied", |world| world.phase() == MotionPhase::Dwell);
    let away = world.away_from_base();
    assert!(away < 1e-6, "{away} m");
    world.run(2.0);
    assert_eq!(world.phase(), MotionPhase::Dwell);
    world.decide(None);
    world.until(4.0, "at rest", |world| world.phase() == MotionPhase::Rest);
}

#[test]
fn a_planner_that_is_held_back_is_waited_for() {
    let begins_after = |delay: PlannerDelay| {
        let mut world = KinematicWorld::new();
        world.control.hold_plans_back(delay);
        world.decide(Some(world.action(ActionType::Insert, NUT)));
        let moves = |world: &KinematicWorld| world.command.velocity[..7].iter().any(|speed| *speed != 0.0);
        let waited = world.until(2.0, "under way", moves);
        world.until(8.0, "inserted", |world| {
            world.parts.iter().any(|part| matches!(part.holder, Holder::Socket(_)))
        });
        (waited * 1e3).round() as u64
    };
    let at_once = begins_after(PlannerDelay::None);
    let late = begins_after(PlannerDelay::Fixed(Duration::from_millis(250)));
    assert!((249..=250).contains(&(late - at_once)), "{at_once} and {late} ms");
    assert!(begins_after(PlannerDelay::Measured) > at_once);
}

#[test]
fn a_changed_decision_bends_the_movement_without_a_stop() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.run(0.7);
    let speed = |command: &Command| command.velocity[..7].iter().map(|v| v * v).sum::<f64>().sqrt();
    assert!(speed(&world.command) > 0.3, "under way");
    world.decide(Some(world.action(ActionType::Request, WHEEL)));
    let mut slowest = f64::INFINITY;
    for _ in 0..200 {
        world.step();
        slowest = slowest.min(speed(&world.command));
    }
    assert!(slowest > 0.1, "it stopped: {slowest} rad/s");
    world.until(4.0, "held out", |world| world.phase() == MotionPhase::Dwell);
}

#[test]
fn closing_fingers_finish_before_another_decision_counts() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(5.0, "closing", |world| world.phase() == MotionPhase::Grasp);
    world.decide(None);
    world.until(2.0, "lifted", |world| world.phase() == MotionPhase::Transport);
    assert!(world.held().is_some());
}

#[test]
fn an_unwanted_part_is_kept_for_a_while_and_then_put_back_where_it_was() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(5.0, "taken", |world| world.held().is_some());
    let part = world.parts.iter().position(|part| part.holder == Holder::Robot).unwrap();
    let from = world.task.parts[part].at;
    world.decide(None);
    world.run(4.0);
    assert!(world.held().is_some(), "kept");
    world.until(8.0, "put back", |world| world.held().is_none());
    let place = world.parts[part].frame.translation.vector;
    assert!((place.x - from[0]).hypot(place.y - from[1]) < 0.01, "{place}, taken from {from:?}");
}

/// A world in which a control that knows nothing finds column 3 between the fingers, pushed in by somebody with its underside to the palm: to
/// stand, or to go into its hole, it would need the hand below the table. Tells the column's index as well.
fn held_upside_down() -> (KinematicWorld, usize) {
    let mut world = KinematicWorld::new();
    let part = lay_down(&mut world, COLUMN_3);
    world.decide(Some(world.action(ActionType::Insert, COLUMN_3)));
    world.until(5.0, "taken", |world| world.held().is_some());
    world.decide(None);
    world.until(4.0, "at rest", |world| world.phase() == MotionPhase::Rest);
    world.give(part, Isometry3::translation(0.0, 0.0, 0.08));
    world.control = KinematicWorld::new().control;
    world.command.state.fill(0.0);
    (world, part)
}

#[test]
fn a_part_that_cannot_be_put_back_upright_is_laid_down() {
    let (mut world, _) = held_upside_down();
    world.run(3.0);
    assert!(world.held().is_some(), "kept");
    world.until(20.0, "laid down", |world| world.held().is_none());
    let highest = world.grasp_point().z - world.task.scene.table_height;
    assert!(highest < 0.15, "let go {highest} m above the table");
    world.until(6.0, "at rest", |world| world.phase() == MotionPhase::Rest);
}

#[test]
fn a_part_that_cannot_be_inserted_as_it_is_held_is_laid_down_and_taken_otherwise() {
    let (mut world, part) = held_upside_down();
    world.run(1.0);
    world.decide(Some(world.action(ActionType::Insert, COLUMN_3)));
    world.until(40.0, "mounted", |world| matches!(world.parts[part].holder, Holder::Socket(_)));
}

#[test]
fn a_lost_part_is_noticed_and_taken_again() {
    let mut world = KinematicWorld::new();
    world.decide(Some(world.action(ActionType::Insert, NUT)));
    world.until(5.0, "taken", |world| world.held().is_some());
    world.until(2.0, "transport", |world| world.phase() == MotionPhase::Transport);
    world.run(0.6);
    let part = world.parts.iter().position(|part| part.holder == Holder::Robot).unwrap();
    world.parts[part].holder = Holder::Nobody;
    world.parts[part].workspace = ROBOT;
    world.parts[part].frame = Isometry3::translation(-0.40, 0.60, world.task.scene.table_height);
    world.until(12.0, "mounted", |world| matches!(world.parts[part].holder, Holder::Socket(_)));
}

#[test]
fn a_restarted_control_goes_on_with_the_same_bits() {
    let run = |restart_at: &[u64]| {
        let mut world = KinematicWorld::new();
        world.decide(Some(world.action(ActionType::Insert, NUT)));
        let mut path = Vec::new();
        for step in 0..9000 {
            if restart_at.contains(&step) {
                let last = world.command.clone();
                world.control = KinematicWorld::new().control;
                world.control.resume(&last);
            }
            world.step();
            path.push(world.command.position);
        }
        (path, world.parts.iter().any(|part| matches!(part.holder, Holder::Socket(_))))
    };
    let (path, mounted) = run(&[]);
    assert!(mounted);
    assert_eq!(run(&[1, 5, 12, 700, 1500, 2000, 2600, 4000, 5200]).0, path);
}
