#![allow(clippy::unwrap_used)]

mod carrying;
mod fake_robot;
mod grasping;
mod handover;
mod hesitating;
mod hidden;
mod inserting;
mod left_hand;
mod live;
mod manipulator;
mod mid_reach;
mod mistakes;
mod partner;
mod people;
mod physics;
mod profiles;
mod recorded;
mod recorded_arm;
mod resume;
mod returning;
mod script;
mod spoken;
mod turning;
mod undoing;

use super::World;
use crate::{Partner, Settings};
use bytemuck::zeroed_box;
use coact_joint_task::{Agent, Task};
use coact_messages::{Command, DriveMode, Header, JOINTS, LAYOUT, SensorSample, Truth, WorldState};
use coact_person::{Habits, Holder};
use coact_pipeline::WorldMode;
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use std::path::{Path, PathBuf};

/// Forces of which fingers and wrist feel no more than this are nothing but their sensors' noise, N.
pub(super) const NOISE: f64 = 0.2;

/// Messages of one step.
pub(super) struct Out {
    pub sample: Box<SensorSample>,
    pub truth: Box<Truth>,
    pub state: Box<WorldState>,
}

impl Out {
    pub fn new() -> Self {
        Self { sample: zeroed_box(), truth: zeroed_box(), state: zeroed_box() }
    }
}

pub(super) fn config(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file)
}

/// The toy vehicle on a table of the test's own, whatever the file's scene is.
pub(super) fn task() -> Task {
    let mut task = Task::load(&config("tasks/toy-vehicle.toml")).unwrap();
    let scene = &mut task.scene;
    scene.table_height = 0.9;
    scene.table_centre = [-0.6, 0.0];
    scene.table_size = [0.8, 1.2];
    scene.platform = [-0.6, 0.0, 0.9];
    scene.steady = vec![[-0.5, 0.0, 1.0]];
    scene.handover = [-0.6, 0.3, 1.1];
    scene.person_rest = [-1.0, 0.2, 0.93];
    scene.person_shoulder = [-1.15, 0.15, 1.25];
    scene.workspace = [[[-0.45, -0.6], [-0.2, 0.6]], [[-1.0, -0.6], [-0.75, 0.6]]];
    let mut placed = [0, 0];
    for part in &mut task.parts {
        let side = part.workspace.index();
        part.at =
            [if part.workspace == Agent::Robot { -0.3 } else { -0.85 }, -0.3 + 0.15 * placed[side] as f64];
        placed[side] += 1;
    }
    for (index, goal) in task.subgoals.iter_mut().enumerate() {
        let x = if goal.side == Agent::Robot { -0.55 } else { -0.65 };
        goal.socket = [x, 0.08 * index as f64 - 0.3, 0.95];
    }
    task
}

pub(super) fn robot() -> Robot {
    Robot::load(&config("robots/aros.toml")).unwrap()
}

pub(super) fn world(seed: u64) -> World {
    World::new(&task(), &robot(), settings(seed, Partner::Synthetic, WorldMode::Kinematic)).unwrap()
}

/// Those of a world whose person moves as the partner does.
pub(super) fn settings(seed: u64, partner: Partner, mode: WorldMode) -> Settings {
    Settings { seed, partner, habits: habits(), reaches: None, ways: None, mode, drive: safety().drive }
}

/// The command that takes the joints on as `course`, where they are at each tick, goes on; none before they are driven.
pub(super) fn onwards(
    tick: u64,
    sample: &SensorSample,
    course: impl Fn(u64) -> [f64; JOINTS],
) -> Option<Box<Command>> {
    if sample.drive.mode == DriveMode::Absent as u32 {
        return None;
    }
    let (before, now) = (course(tick - 1), course(tick));
    let mut command: Box<Command> = zeroed_box();
    command.header = Header { layout: LAYOUT, sequence: tick, cycle: tick - 1, ..Header::default() };
    command.position = std::array::from_fn(|joint| sample.drive.position[joint] + now[joint] - before[joint]);
    Some(command)
}

/// A command that sways the wrist, so that joints move.
pub(super) fn swaying(tick: u64, sample: &SensorSample) -> Option<Box<Command>> {
    onwards(tick, sample, |tick| {
        let mut course = [0.0; JOINTS];
        course[5] = 0.2 * (tick as f64 * 2e-3).sin().powi(3);
        course
    })
}

pub(super) fn habits() -> Habits {
    Habits::load(&config("person.toml"), &task()).unwrap()
}

pub(super) fn safety() -> SafetyLimits {
    SafetyLimits::load(&config("safety.toml")).unwrap()
}

/// The parts that someone has.
pub(super) fn held_by(world: &World, holder: Holder) -> Vec<usize> {
    (0..world.parts.all().len()).filter(|part| world.parts.is(*part, holder)).collect()
}
