//! The toy vehicle's parts, and a person among them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use bytemuck::Zeroable;
use coact_joint_task::Task;
use coact_messages::{NONE, PartState};
use coact_person::{Habits, Holder, PartsView, Person, PersonState, Policy, RobotHandView, Surroundings};
use coact_random::RandomStreams;
use std::path::{Path, PathBuf};

fn config(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file)
}

/// Who and what there is.
pub struct Scene {
    pub task: Task,
    pub parts: Vec<PartState>,
    pub robot: RobotHandView,
    pub person: Person,
    pub state: PersonState,
    pub tick: u64,
}

impl Scene {
    /// All parts as the task lays them out, the person at rest.
    pub fn new(policy: Policy, seed: u64) -> Self {
        let task = Task::load(&config("tasks/toy-vehicle.toml")).unwrap();
        let lying = |part: &coact_joint_task::Part| PartState {
            position: [part.at[0], part.at[1], task.scene.table_height],
            orientation: [0.0, 0.0, 0.0, 1.0],
            kind: part.kind as u32,
            subgoal: NONE,
            ..PartState::default()
        };
        let parts = task.parts.iter().map(lying).collect();
        let habits = Habits::load(&config("person.toml"), &task).unwrap();
        let person = Person::new(&task.scene, &habits, policy, RandomStreams::new(seed), None);
        let mut state = PersonState::zeroed();
        person.start(0, &mut state);
        Self { task, parts, robot: RobotHandView::default(), person, state, tick: 0 }
    }

    /// One tick; the parts follow the hand as in the world.
    pub fn step(&mut self) {
        let parts = self.parts.clone();
        let (parts, robot) = (PartsView::new(&parts), self.robot);
        let around = Surroundings { tick: self.tick, task: &self.task, parts, robot };
        let done = self.person.advance(&mut self.state, &around);
        if let Some(part) = done.grasped {
            self.parts[part].state = Holder::Person as u32;
        }
        if let Some((part, position, turn)) = done.moved {
            self.parts[part].position = position.into();
            self.parts[part].orientation = turn.into();
        }
        if let Some(part) = done.released {
            let owner = if self.robot.held == Some(part) { Holder::Robot } else { Holder::Nobody };
            self.parts[part].state = owner as u32;
        }
        self.person.check(&self.state, &self.task, self.tick).unwrap();
    }
}
