//! A planner that hangs is found by control; one that works is not taken for one. It counts time: a program of its own.
#![allow(clippy::unwrap_used)]

#[path = "control/kinematic_world.rs"]
mod kinematic_world;

use coact_control::Control;
use coact_period::PERIOD;
use kinematic_world::KinematicWorld;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// A decision changes after so many cycles: each asks for a movement.
const CHANGES: u64 = 300;

/// Steps control with a planner that `freezes`, so many cycles at this pace; whether it was found hung in any, and how often the
/// arm moved.
fn run(freezes: bool, cycles: u64, pace: Duration) -> (bool, u64) {
    let mut world = KinematicWorld::new();
    let limits = kinematic_world::limits();
    let (control, planner) = Control::in_real_time(world.robot.clone(), &world.task, &limits).unwrap();
    world.control = control;
    std::thread::spawn(move || planner.run(&AtomicBool::new(freezes)));
    let actions = world.task.actions.len() as u64;
    let mut moved = 0;
    for cycle in 0..cycles {
        if cycle % CHANGES == 0 {
            world.decide(Some((cycle / CHANGES % actions) as u32));
        }
        world.step();
        moved += u64::from(world.command.velocity[0].abs() > 0.05);
        if world.control.planner_hangs(|_| false) {
            return (true, moved);
        }
        std::thread::sleep(pace);
    }
    (false, moved)
}

#[test]
fn a_planner_that_stands_still_hangs() {
    assert_eq!(run(true, 2000, Duration::ZERO), (true, 0));
}

#[test]
fn a_planner_that_answers_does_not_hang() {
    let (hangs, moved) = run(false, 3000, PERIOD);
    assert!(!hangs && moved > 100, "moved in {moved} cycles");
}
