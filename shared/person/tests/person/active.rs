//! A partner who prepares: takes the part that is next while the robot mounts what comes before it, and mounts it when its turn has come.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::scene::Scene;
use coact_messages::PartnerError;
use coact_person::{ActivityPhase, Holder, PartsView, Policy};

impl Scene {
    /// A half built toy vehicle: all that comes before `step` is mounted, and the robot has the part for it.
    fn before(step: &str, policy: Policy, seed: u64) -> Self {
        let mut scene = Self::new(policy, seed);
        let step = scene.goal(step);
        scene.mount_what_comes_before(step);
        let held = scene.free_part(step);
        scene.parts[held].state = Holder::Robot as u32;
        scene.robot.held = Some(held);
        scene
    }

    fn goal(&self, name: &str) -> usize {
        self.task.subgoals.iter().position(|goal| goal.name == name).unwrap()
    }

    fn free_part(&self, step: usize) -> usize {
        let is_free = |part: &coact_messages::PartState| part.state == Holder::Nobody as u32;
        let kind = self.task.subgoals[step].kind as u32;
        self.parts.iter().position(|part| part.kind == kind && is_free(part)).unwrap()
    }

    fn mount_what_comes_before(&mut self, step: usize) {
        for before in self.task.subgoals[step].after.clone() {
            self.mount_what_comes_before(before);
            if PartsView::new(&self.parts).achieved() & (1 << before) == 0 {
                let part = self.free_part(before);
                self.mount(part, before);
            }
        }
    }

    fn mount(&mut self, part: usize, step: usize) {
        let socket = self.task.subgoals[step].socket;
        let mounted = &mut self.parts[part];
        (mounted.state, mounted.subgoal, mounted.position) = (Holder::Socket as u32, step as u32, socket);
    }

    /// Lets so many ticks pass; tells the phases that the person has gone through.
    fn run(&mut self, ticks: u64) -> Vec<ActivityPhase> {
        let mut phases = vec![self.state.phase()];
        for _ in 0..ticks {
            self.tick += 1;
            self.step();
            if phases.last() != Some(&self.state.phase()) {
                phases.push(self.state.phase());
            }
        }
        phases
    }
}

#[test]
fn takes_the_next_part_while_the_robot_mounts_and_mounts_it_then() {
    for seed in 0..8 {
        let mut scene = Scene::before("column 1 in its hole", Policy::Active, seed);
        let phases = scene.run(6000);
        assert_eq!(phases.last(), Some(&ActivityPhase::AwaitTurn), "{phases:?}");
        assert_eq!(scene.state.error, PartnerError::None);
        let part = scene.state.held.get().unwrap();
        let above = scene.parts[part].position[2] - scene.task.scene.table_height;
        assert!((0.05..0.12).contains(&above), "held ready {above} m above the table");
        let column = scene.robot.held.take().unwrap();
        scene.mount(column, scene.goal("column 1 in its hole"));
        let phases = scene.run(3000);
        assert!(phases.contains(&ActivityPhase::AwaitSteadying), "{phases:?}");
    }
}

#[test]
fn holds_out_what_the_robot_needs_next_before_its_hand_is_free() {
    let mut scene = Scene::before("nut on the robot's side", Policy::Active, 1);
    let own = scene.goal("nut on the person's side");
    scene.mount_what_comes_before(own);
    let nut = scene.free_part(own);
    scene.mount(nut, own);
    let phases = scene.run(6000);
    assert_eq!(phases.last(), Some(&ActivityPhase::Give), "{phases:?}");
    assert_eq!(scene.state.subgoal.get(), Some(scene.goal("column 1 in its hole")));
    assert_eq!(scene.state.error, PartnerError::None);
}

#[test]
fn lets_the_robot_finish_that_is_at_work_beside_the_place_where_the_part_goes() {
    for (policy, yields) in [(Policy::Active, true), (Policy::Synthetic, false)] {
        let mut scene = Scene::before("wheel on the robot's side", policy, 1);
        let [x, y, z] = scene.task.subgoals[scene.goal("wheel on the person's side")].socket;
        let wheel = scene.robot.held.unwrap();
        scene.parts[wheel].position = [x + 0.1, y, z];
        let phases = scene.run(6000);
        assert_eq!(phases.contains(&ActivityPhase::AwaitTurn), yields, "{phases:?}");
        if yields {
            assert!(!phases.contains(&ActivityPhase::AwaitSteadying), "{phases:?}");
            scene.parts[wheel].position = [x + 0.3, y, z];
            assert!(scene.run(2000).contains(&ActivityPhase::AwaitSteadying), "it has left");
        }
    }
}

#[test]
fn puts_it_back_when_the_turn_does_not_come() {
    let mut scene = Scene::before("column 1 in its hole", Policy::Active, 1);
    scene.run(6000);
    let part = scene.state.held.get().unwrap();
    let lay = scene.task.parts[part].at;
    let phases = scene.run(16_000);
    assert!(phases.contains(&ActivityPhase::Return), "{phases:?}");
    assert!(!phases.contains(&ActivityPhase::Mount), "{phases:?}");
    let [x, y, _] = scene.parts[part].position;
    assert!((x - lay[0]).hypot(y - lay[1]) < 0.05);
}

#[test]
fn the_passive_one_waits_and_nobody_prepares_what_is_far_off() {
    for (step, policy) in
        [("column 1 in its hole", Policy::Synthetic), ("nut on the robot's side", Policy::Active)]
    {
        let mut scene = Scene::before(step, policy, 1);
        scene.run(6000);
        let named = scene.state.subgoal.get().map(|goal| scene.task.subgoals[goal].name.as_str());
        let prepares = scene.state.phase() == ActivityPhase::AwaitTurn;
        assert!(!prepares && !named.is_some_and(|name| name.starts_with("column 2")), "{step}: {named:?}");
    }
}
