//! A step allocates nothing on the heap, in any phase of any skill.
#![allow(clippy::unwrap_used)]

#[path = "control/kinematic_world.rs"]
mod kinematic_world;

use allocation_counter::measure;
use coact_control::Control;
use kinematic_world::KinematicWorld;
use std::sync::atomic::AtomicBool;

/// Time of a cycle here: the planner has its own pace.
const CYCLE: std::time::Duration = std::time::Duration::from_micros(100);

#[test]
fn a_step_allocates_nothing() {
    let mut world = KinematicWorld::new();
    let limits = kinematic_world::limits();
    let (control, planner) = Control::in_real_time(world.robot.clone(), &world.task, &limits).unwrap();
    world.control = control;
    std::thread::spawn(move || planner.run(&AtomicBool::new(false)));
    let actions = world.task.actions.len() as u32;
    let mut times = Vec::with_capacity(40_000);
    let (mut counted, mut moved) = (0, 0);
    let (mut command, mut previous) = (world.command.clone(), world.command.clone());
    for tick in 0..40_000u32 {
        if tick % 1_300 == 0 {
            world.decide(Some((tick / 1_300) % (actions + 2)));
        }
        world.sense();
        let KinematicWorld { control, sample, percept, frame, tick: now, .. } = &mut world;
        let last = (tick > 0).then_some(&*previous);
        let started = std::time::Instant::now();
        let allocations =
            measure(|| control.step(*now, Some(sample), Some(percept), Some(frame), last, &mut command));
        times.push(started.elapsed());
        counted += allocations.count_total;
        *previous = *command;
        *world.command = *command;
        world.tick += 1;
        moved += u32::from(world.command.velocity[0].abs() > 0.1);
        std::thread::sleep(CYCLE);
    }
    // For information only: the figures of a debug build on a busy machine prove nothing.
    times.sort_unstable();
    println!("step: p50 {:?}, p99 {:?}, p99.9 {:?}", times[20_000], times[39_600], times[39_960]);
    assert_eq!(counted, 0);
    assert!(moved > 1_000, "the arm moved in {moved} cycles only");
    assert!(measure(|| drop(std::hint::black_box(Box::new(0_u8)))).count_total > 0, "the counter counts");
}
