use super::super::World;
use super::Out;
use crate::palm::Palm;
use coact_joint_task::{Agent, Task};
use coact_person::ActivityPhase;
use coact_person::Holder;
use coact_stage_state::Flag;
use glam::{DQuat, DVec3};

/// A robot hand without an arm: it is where it wants to be at once, and obeys the world's rules of grasping.
pub(in super::super) struct FakeRobot {
    at: DVec3,
    finger_closure: f64,
    /// Tick until which it stays as it is.
    busy_until: u64,
    /// Ticks to stay away after something was given.
    pause: u64,
    skill: Skill,
}

#[derive(Clone, Copy, PartialEq)]
enum Skill {
    None,
    /// Grasp the part, then go on with `Insert` or `Give`.
    Insert(usize, usize),
    Give(usize),
    Receive(usize),
}

impl FakeRobot {
    pub fn new() -> Self {
        Self {
            at: DVec3::new(0.0, 0.0, 2.0),
            finger_closure: 0.0,
            busy_until: 0,
            pause: 0,
            skill: Skill::None,
        }
    }

    /// One tick of the world with this robot in it.
    pub fn step(&mut self, tick: u64, world: &mut World, out: &mut Out) {
        if tick >= self.busy_until {
            self.act(world);
            self.busy_until = tick + 60 + std::mem::take(&mut self.pause);
        }
        let palm =
            Palm { grasp_point: self.at, orientation: DQuat::IDENTITY, finger_closure: self.finger_closure };
        let World { parts, task, .. } = world;
        parts.rest_free(task);
        world.live(tick, &palm);
        world.sense(tick, &mut out.sample);
        world.simulation.tick = tick;
        world.simulation.started = Flag::Set;
        world.tell(&mut out.truth);
        world.write(&mut out.state);
    }

    fn act(&mut self, world: &World) {
        let held = world.simulation.robot.held.get();
        match (self.skill, held) {
            (Skill::None, _) => self.skill = self.choose(world),
            (Skill::Receive(part), None) if !world.parts.is(part, Holder::Person) => self.abandon(),
            (Skill::Insert(part, _) | Skill::Give(part) | Skill::Receive(part), None) => {
                self.grasp(part, world)
            }
            (Skill::Receive(part), Some(_)) if world.parts.is(part, Holder::Robot) => {
                let goal = goal(world, world.parts.kind(part), Agent::Robot);
                self.skill = goal.map_or(Skill::None, |goal| Skill::Insert(part, goal));
            }
            (Skill::Receive(_), Some(_)) => {}
            (Skill::Insert(part, goal), Some(_)) => self.insert(part, goal, world),
            (Skill::Give(part), Some(_)) => self.give(part, world),
        }
    }

    fn choose(&mut self, world: &World) -> Skill {
        let task = &world.task;
        let held_out = super::held_by(world, Holder::Person)
            .into_iter()
            .find(|part| world.parts.position(*part).distance(task.scene.handover.into()) < 0.01);
        if let Some(part) = held_out {
            return Skill::Receive(part);
        }
        for goal in open_goals(world, Agent::Robot) {
            if let Some(part) = lying(world, task.subgoals[goal].kind) {
                return Skill::Insert(part, goal);
            }
        }
        // It gives what is requested, and now and then what is not.
        let gives =
            world.simulation.person.phase() == ActivityPhase::Show || world.simulation.tick / 10_000 % 2 == 1;
        for goal in open_goals(world, Agent::Person).into_iter().filter(|_| gives) {
            if let Some(part) = lying(world, task.subgoals[goal].kind) {
                return Skill::Give(part);
            }
        }
        let requests = !open_goals(world, Agent::Robot).is_empty();
        self.at = if requests { task.scene.handover.into() } else { DVec3::new(0.0, 0.0, 2.0) };
        self.finger_closure = 0.0;
        Skill::None
    }

    fn grasp(&mut self, part: usize, world: &World) {
        let there = world.parts.position(part);
        self.finger_closure = if self.at == there && self.finger_closure == 0.0 { 2.0 } else { 0.0 };
        self.at = there;
    }

    fn insert(&mut self, _part: usize, goal: usize, world: &World) {
        let place = DVec3::from(world.task.subgoals[goal].socket);
        if self.at == place {
            self.abandon();
        }
        self.at = place;
    }

    fn give(&mut self, part: usize, world: &World) {
        let home = DVec3::new(world.task.parts[part].at[0], world.task.parts[part].at[1], 0.95);
        let taken = world.simulation.person.held.get() == Some(part);
        let wanted = goal(world, world.parts.kind(part), Agent::Person).is_some();
        if taken || self.at == home {
            self.abandon();
            self.pause = 1500;
        } else {
            self.at = if wanted { world.task.scene.handover.into() } else { home };
        }
    }

    fn abandon(&mut self) {
        self.finger_closure = 0.0;
        self.skill = Skill::None;
    }
}

fn open_goals(world: &World, side: Agent) -> Vec<usize> {
    let task: &Task = &world.task;
    let open =
        |goal: &usize| task.subgoals[*goal].side == side && world.parts.view().is_available(*goal, task);
    (0..task.subgoals.len()).filter(open).collect()
}

fn goal(world: &World, kind: usize, side: Agent) -> Option<usize> {
    open_goals(world, side).into_iter().find(|goal| world.task.subgoals[*goal].kind == kind)
}

fn lying(world: &World, kind: usize) -> Option<usize> {
    world.parts.view().nearest_free(kind, Agent::Robot, DVec3::ZERO, &world.task)
}
