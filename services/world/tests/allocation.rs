//! A step of the kinematic world asks the heap for nothing.
#![allow(clippy::unwrap_used)]

use allocation_counter::measure;
use bytemuck::zeroed_box;
use coact_joint_task::Task;
use coact_messages::{Command, LAYOUT, SensorSample, Truth, WorldState};
use coact_period::{CYCLES_PER_SECOND, seconds};
use coact_person::{Habits, RecordedWays};
use coact_pipeline::WorldMode;
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_world::{Partner, Settings, World};
use std::path::Path;

#[test]
fn steps_of_a_minute_allocate_nothing() {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let task = Task::load(&config.join("tasks/toy-vehicle.toml")).unwrap();
    let robot = Robot::load(&config.join("robots/aros.toml")).unwrap();
    let drive = SafetyLimits::load(&config.join("safety.toml")).unwrap().drive;
    let habits = Habits::load(&config.join("person.toml"), &task).unwrap();
    let scenario = format!("script:{}", config.join("scenarios/proactive.toml").display());
    let data = config.with_file_name("data");
    let recorded = format!("recorded:{}", data.join("reaches").display());
    let recorded_ways = RecordedWays::load(&data.join("carries/carries.csv")).unwrap();
    let random = "random:goal=0.4,hidden=0.2,words=0.2,dropouts=1";
    for partner in ["synthetic", random, &scenario, &recorded] {
        let ways = (partner == recorded).then(|| recorded_ways.clone());
        let partner = Partner::load(partner, &task, 0).unwrap();
        let settings = Settings {
            seed: 1,
            partner,
            habits: habits.clone(),
            reaches: None,
            ways,
            mode: WorldMode::Kinematic,
            drive,
        };
        let mut world = World::new(&task, &robot, settings).unwrap();
        let (mut sample, mut truth, mut state): (Box<SensorSample>, Box<Truth>, Box<WorldState>) =
            (zeroed_box(), zeroed_box(), zeroed_box());
        let mut command: Box<Command> = zeroed_box();
        command.header.layout = LAYOUT;
        let allocations = measure(|| {
            for tick in 1..=60 * CYCLES_PER_SECOND {
                // Setpoints that the drive follows, and some that it refuses.
                command.position = sample.drive.position;
                command.position[8..11].fill(0.5 - 0.5 * (seconds(tick) / 4.0).cos());
                (command.header.cycle, command.header.sequence) = (tick - 1, tick);
                world.step(tick, Some(&command), &mut sample, &mut truth, &mut state);
            }
        });
        assert_eq!(allocations.count_total, 0);
        assert!(truth.actions > 0, "nothing happened that could have allocated");
    }
}
