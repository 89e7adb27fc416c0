//! A step allocates nothing on the heap, in any phase of any skill.
#![allow(clippy::unwrap_used)]

mod kinematic_world;

use coact_control::{Control, Settings};
use kinematic_world::KinematicWorld;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// Counts this thread's allocations.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: every call is passed on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is passed on.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Time of a cycle here: the planner has its own pace.
const CYCLE: std::time::Duration = std::time::Duration::from_micros(100);

#[test]
fn a_step_allocates_nothing() {
    let mut world = KinematicWorld::new();
    let (control, planner) =
        Control::in_real_time(world.robot.clone(), &world.task, Settings::default()).unwrap();
    world.control = control;
    std::thread::spawn(move || planner.run());
    let actions = world.task.actions.len() as u32;
    let mut times = Vec::with_capacity(40_000);
    let (mut counted, mut moved) = (0, 0);
    let (mut command, mut previous) = (world.command.clone(), world.command.clone());
    for tick in 0..40_000u32 {
        if tick % 1_300 == 0 {
            world.decide(Some((tick / 1_300) % (actions + 2)));
        }
        world.sense();
        let before = ALLOCATIONS.with(Cell::get);
        let started = std::time::Instant::now();
        world.control.step(
            world.tick,
            Some(&world.sample),
            Some(&world.percept),
            Some(&world.frame),
            (tick > 0).then_some(&*previous),
            &mut command,
        );
        times.push(started.elapsed());
        counted += ALLOCATIONS.with(Cell::get) - before;
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
    assert!(ALLOCATIONS.with(Cell::get) > 0, "the counter counts");
}
