//! Cost of one servo step in real time: tracking, limits, clearance to a person who moves about, and all decisions, while
//! movements are planned on another thread. `cargo bench -p coact-control --bench servo [-- SECONDS]`.
#![allow(clippy::unwrap_used)]

#[path = "../tests/control/kinematic_world.rs"]
mod kinematic_world;

use coact_control::Control;
use coact_period::{CYCLES_PER_SECOND, PERIOD, seconds};
use hdrhistogram::Histogram;
use kinematic_world::KinematicWorld;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// A decision changes after so many cycles.
const CHANGES: u64 = 1_300;

fn main() {
    let duration = std::env::args().find_map(|argument| argument.parse().ok()).unwrap_or(60u64);
    let mut world = KinematicWorld::new();
    let limits = kinematic_world::limits();
    let (control, planner) = Control::in_real_time(world.robot.clone(), &world.task, &limits).unwrap();
    world.control = control;
    std::thread::spawn(move || planner.run(&AtomicBool::new(false)));
    let actions = world.task.actions.len() as u64;
    let mut times = Histogram::<u64>::new_with_max(1_000_000_000, 3).unwrap();
    let (mut command, mut moving) = (world.command.clone(), 0);
    let start = Instant::now();
    for cycle in 0..CYCLES_PER_SECOND * duration {
        if cycle % CHANGES == 0 {
            world.decide(Some((cycle / CHANGES % (actions + 1)) as u32));
        }
        let at = seconds(cycle);
        world.hand_at([-0.75 + 0.25 * (0.7 * at).sin(), 0.35 + 0.25 * (0.5 * at).cos(), 1.0]);
        world.sense();
        let before = Instant::now();
        world.control.step(
            world.tick,
            Some(&world.sample),
            Some(&world.percept),
            Some(&world.frame),
            None,
            &mut command,
        );
        times.saturating_record(before.elapsed().as_nanos() as u64);
        *world.command = *command;
        moving += u64::from(command.velocity[..7].iter().any(|velocity| velocity.abs() > 0.05));
        world.tick += 1;
        std::thread::sleep((start + PERIOD * (cycle as u32 + 1)).saturating_duration_since(Instant::now()));
    }
    let at = |fraction| times.value_at_quantile(fraction) as f64 * 1e-3;
    println!(
        "servo step over {duration} s, in motion {} %: p50 {:.1}, p99 {:.1}, p99.9 {:.1}, max {:.1} µs",
        100 * moving / (CYCLES_PER_SECOND * duration),
        at(0.5),
        at(0.99),
        at(0.999),
        times.max() as f64 * 1e-3
    );
}
