//! A partner who prepares: takes the part that is next while the robot mounts what comes before it, and mounts it when its turn has come.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::scene::Scene;
use coact_messages::PartnerError;
use coact_person::{ActivityPhase, Holder, PartsView, Policy};

/// A person beside a half built toy vehicle, the robot with a part in its hand.
struct Bench(Scene);

impl Bench {
    /// All that comes before `step` is mounted, and the robot has the part for it.
    fn before(step: &str, policy: Policy, seed: u64) -> Self {
        let mut bench = Self(Scene::new(policy, seed));
        let step = bench.step(step);
        bench.mount_what_comes_before(step);
        let held = bench.free_part(step);
        bench.0.parts[held].state = Holder::Robot as u32;
        bench.0.robot.held = Some(held);
        bench
    }

    fn step(&self, name: &str) -> usize {
        self.0.task.subgoals.iter().position(|goal| goal.name == name).unwrap()
    }

    fn free_part(&self, step: usize) -> usize {
        let is_free = |part: &coact_messages::PartState| part.state == Holder::Nobody as u32;
        let kind = self.0.task.subgoals[step].kind as u32;
        self.0.parts.iter().position(|part| part.kind == kind && is_free(part)).unwrap()
    }

    fn mount_what_comes_before(&mut self, step: usize) {
        for before in self.0.task.subgoals[step].after.clone() {
            self.mount_what_comes_before(before);
            if PartsView::new(&self.0.parts).achieved() & (1 << before) == 0 {
                let part = self.free_part(before);
                self.mount(part, before);
            }
        }
    }

    fn mount(&mut self, part: usize, step: usize) {
        let socket = self.0.task.subgoals[step].socket;
        let mounted = &mut self.0.parts[part];
        (mounted.state, mounted.subgoal, mounted.position) = (Holder::Socket as u32, step as u32, socket);
    }

    /// Lets so many ticks pass; tells the phases that the person has gone through.
    fn run(&mut self, ticks: u64) -> Vec<ActivityPhase> {
        let mut phases = vec![self.0.state.phase()];
        for _ in 0..ticks {
            self.0.tick += 1;
            self.0.step();
            if phases.last() != Some(&self.0.state.phase()) {
                phases.push(self.0.state.phase());
            }
        }
        phases
    }
}

#[test]
fn takes_the_next_part_while_the_robot_mounts_and_mounts_it_then() {
    for seed in 0..8 {
        let mut bench = Bench::before("column 1 in its hole", Policy::Active, seed);
        let phases = bench.run(6000);
        assert_eq!(phases.last(), Some(&ActivityPhase::AwaitTurn), "{phases:?}");
        assert_eq!(bench.0.state.error, PartnerError::None);
        let part = bench.0.state.held.get().unwrap();
        let above = bench.0.parts[part].position[2] - bench.0.task.scene.table_height;
        assert!((0.05..0.12).contains(&above), "held ready {above} m above the table");
        let column = bench.0.robot.held.take().unwrap();
        bench.mount(column, bench.step("column 1 in its hole"));
        let phases = bench.run(3000);
        assert!(phases.contains(&ActivityPhase::AwaitSteadying), "{phases:?}");
    }
}

#[test]
fn holds_out_what_the_robot_needs_next_before_its_hand_is_free() {
    let mut bench = Bench::before("nut on the robot's side", Policy::Active, 1);
    let own = bench.step("nut on the person's side");
    bench.mount_what_comes_before(own);
    let nut = bench.free_part(own);
    bench.mount(nut, own);
    let phases = bench.run(6000);
    assert_eq!(phases.last(), Some(&ActivityPhase::Give), "{phases:?}");
    assert_eq!(bench.0.state.subgoal.get(), Some(bench.step("column 1 in its hole")));
    assert_eq!(bench.0.state.error, PartnerError::None);
}

#[test]
fn puts_it_back_when_the_turn_does_not_come() {
    let mut bench = Bench::before("column 1 in its hole", Policy::Active, 1);
    bench.run(6000);
    let part = bench.0.state.held.get().unwrap();
    let lay = bench.0.task.parts[part].at;
    let phases = bench.run(16_000);
    assert!(phases.contains(&ActivityPhase::Return), "{phases:?}");
    assert!(!phases.contains(&ActivityPhase::Mount), "{phases:?}");
    let [x, y, _] = bench.0.parts[part].position;
    assert!((x - lay[0]).hypot(y - lay[1]) < 0.05);
}

#[test]
fn the_passive_one_waits_and_nobody_prepares_what_is_far_off() {
    for (step, policy) in
        [("column 1 in its hole", Policy::Synthetic), ("nut on the robot's side", Policy::Active)]
    {
        let mut bench = Bench::before(step, policy, 1);
        bench.run(6000);
        let named = bench.0.state.subgoal.get().map(|goal| bench.0.task.subgoals[goal].name.as_str());
        let prepares = bench.0.state.phase() == ActivityPhase::AwaitTurn;
        assert!(!prepares && !named.is_some_and(|name| name.starts_with("column 2")), "{step}: {named:?}");
    }
}
