//! Two instances of control, a stage and its standby, number their queries alike: each takes only answers to its own newest.
#![allow(clippy::unwrap_used)]

use crate::kinematic_world::{self, KinematicWorld};
use coact_control::Control;
use coact_joint_task::ActionType;
use coact_messages::{ARM_JOINTS, MotionPhase};
use coact_period::PERIOD;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Within this every query is answered. Chosen by hand: some milliseconds, on a machine that is busy.
const ANSWERED: Duration = Duration::from_secs(2);

/// A world whose control has a planner beside it.
fn world() -> KinematicWorld {
    let mut world = KinematicWorld::new();
    let limits = kinematic_world::limits();
    let (control, planner) = Control::in_real_time(world.robot.clone(), &world.task, &limits).unwrap();
    world.control = control;
    std::thread::spawn(move || planner.run(&AtomicBool::new(false)));
    world
}

/// Runs until the hand dwells at its goal, at real time's pace; how far from where the base is steadied, m.
fn dwells(world: &mut KinematicWorld) -> f64 {
    for _ in 0..10_000 {
        world.step();
        std::thread::sleep(PERIOD / 4);
        if world.phase() == MotionPhase::Dwell {
            return world.away_from_base();
        }
    }
    panic!("the hand never came to its goal: {:?}", world.phases);
}

#[test]
fn an_answer_to_what_was_asked_before_another_instances_command_is_not_taken() {
    let mut world = world();
    (0..10).for_each(|_| world.step());
    let of_other = world.command.clone();
    world.decide(Some(world.action(ActionType::Request, "wheel on the robot's side")));
    world.step();
    std::thread::sleep(ANSWERED);
    // The command that counts was the other's, which has asked for nothing: the next query has the same number.
    world.command = of_other;
    world.decide(Some(world.action(ActionType::Steady, "wheel on the person's side")));
    let away = dwells(&mut world);
    assert!(away < 0.02, "{away} m away from where the base is steadied");
}

#[test]
fn a_query_of_another_instance_is_made_again() {
    let (mut world, mut other) = (world(), world());
    for world in [&mut world, &mut other] {
        (0..10).for_each(|_| world.step());
    }
    world.decide(Some(world.action(ActionType::Request, "wheel on the robot's side")));
    other.decide(Some(other.action(ActionType::Steady, "wheel on the person's side")));
    // Both ask in the same cycle, and the other's command counts.
    [&mut world, &mut other].into_iter().for_each(KinematicWorld::step);
    std::thread::sleep(ANSWERED);
    world.command = other.command;
    world.frame = other.frame;
    let away = dwells(&mut world);
    assert!(away < 0.02, "{away} m away from where the base is steadied");
}

#[test]
fn a_standby_has_the_answer_that_its_stage_waits_for_when_that_dies() {
    let mut stage = KinematicWorld::new();
    let limits = kinematic_world::limits();
    let of_robot = || Control::in_real_time(stage.robot.clone(), &stage.task, &limits).unwrap();
    // The stage's planner never answers.
    let ((stage_control, _silent), (mut standby, planner)) = (of_robot(), of_robot());
    std::thread::spawn(move || planner.run(&AtomicBool::new(false)));
    stage.control = stage_control;
    (0..10).for_each(|_| stage.step());
    stage.decide(Some(stage.action(ActionType::Steady, "wheel on the person's side")));
    let mut sent = stage.command.clone();
    let mut stand_by = |stage: &mut KinematicWorld| {
        stage.sense();
        let (sample, percept, frame) = (&stage.sample, &stage.percept, &stage.frame);
        standby.step(stage.tick, Some(sample), Some(percept), Some(frame), Some(&stage.command), &mut sent);
        sent.velocity.iter().take(ARM_JOINTS).any(|speed| *speed != 0.0)
    };
    for _ in 0..10 {
        stand_by(&mut stage);
        stage.step();
    }
    std::thread::sleep(ANSWERED);
    for cycle in 0..10 {
        assert!(stand_by(&mut stage), "cycle {cycle}: it had two seconds to plan the same movement");
        stage.step();
        assert!(stage.command.velocity.iter().all(|speed| *speed == 0.0));
    }
}
