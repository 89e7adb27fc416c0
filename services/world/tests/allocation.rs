//! A step of the kinematic world asks the heap for nothing.
#![allow(clippy::unwrap_used)]

use bytemuck::zeroed_box;
use coact_joint_task::Task;
use coact_messages::{Command, SensorSample, Truth, WorldState};
use coact_pipeline::WorldMode;
use coact_robot::Robot;
use coact_world::{Partner, Settings, World};
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is passed on unchanged to the system's allocator, which keeps the contract.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn steps_of_a_minute_allocate_nothing() {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let task = Task::load(&config.join("tasks/toy-vehicle.toml")).unwrap();
    let robot = Robot::load(&config.join("robots/aros.toml")).unwrap();
    let scenario = format!("script:{}", config.join("scenarios/proactive.toml").display());
    for partner in ["synthetic", "random:goal=0.4,hidden=0.2,words=0.2,dropouts=1", &scenario] {
        let partner = Partner::load(partner, &task, 0).unwrap();
        let settings = Settings { seed: 1, partner, mode: WorldMode::Kinematic };
        let mut world = World::new(&task, &robot, settings).unwrap();
        let (mut sample, mut truth, mut state): (Box<SensorSample>, Box<Truth>, Box<WorldState>) =
            (zeroed_box(), zeroed_box(), zeroed_box());
        let mut command: Box<Command> = zeroed_box();
        command.position[..7].copy_from_slice(&robot.park);
        let before = ALLOCATIONS.load(Ordering::Relaxed);
        for tick in 1..=60_000 {
            command.position[8..11].fill(0.5 + 0.5 * (tick as f64 * 1e-3).sin());
            world.step(tick, Some(&command), &mut sample, &mut truth, &mut state);
        }
        assert_eq!(ALLOCATIONS.load(Ordering::Relaxed) - before, 0);
        assert!(truth.actions > 0, "nothing happened that could have allocated");
    }
}
