//! One tick of the world: what the lockstep and the real-time cycle pay for it.

use bytemuck::zeroed_box;
use coact_joint_task::Task;
use coact_messages::{Command, LAYOUT, SensorSample, Truth, WorldState};
use coact_period::seconds;
use coact_person::Habits;
use coact_pipeline::WorldMode;
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_world::{Partner, Settings, World};
use criterion::{Criterion, criterion_group, criterion_main};
use std::path::Path;

fn step(criterion: &mut Criterion) {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let task = Task::load(&config.join("tasks/toy-vehicle.toml")).expect("the project's own task");
    let robot = Robot::load(&config.join("robots/aros.toml")).expect("the project's own robot");
    let drive = SafetyLimits::load(&config.join("safety.toml")).expect("the project's own limits").drive;
    let habits = Habits::load(&config.join("person.toml"), &task).expect("the project's own people");
    for mode in [WorldMode::Kinematic, WorldMode::Physics] {
        let settings = Settings {
            seed: 1,
            partner: Partner::Synthetic,
            habits: habits.clone(),
            reaches: None,
            ways: None,
            mode,
            drive,
        };
        let mut world = World::new(&task, &robot, settings).expect("the project's own scene");
        let (mut sample, mut truth, mut state): (Box<SensorSample>, Box<Truth>, Box<WorldState>) =
            (zeroed_box(), zeroed_box(), zeroed_box());
        let mut command: Box<Command> = zeroed_box();
        command.header.layout = LAYOUT;
        let mut tick = 0;
        criterion.bench_function(&format!("world step, {mode:?}"), |bench| {
            bench.iter(|| {
                tick += 1;
                (command.header.cycle, command.header.sequence) = (tick - 1, tick);
                command.position = sample.drive.position;
                command.position[0] += 1e-8 * seconds(tick).sin();
                world.step(tick, Some(&command), &mut sample, &mut truth, &mut state);
            });
        });
    }
}

criterion_group!(benches, step);
criterion_main!(benches);
