//! Robot and synthetic partner build the whole vehicle, and do so in the same way each time.
#![allow(clippy::unwrap_used)]

use crate::shipped::{configuration, settings};
use coact_lockstep::Lockstep;
use coact_messages::{ArmSide, LayerKind, Truth};
use coact_period::cycles;
use coact_pipeline::RunSettings;
use std::collections::BTreeSet;
use std::time::Duration;

/// Time within which every assembly must be done: three times what it usually takes.
const LONGEST: u64 = cycles(Duration::from_secs(180));

#[test]
fn vehicle_is_built_with_every_partner_in_an_order_that_the_plan_allows() {
    let left_handed = "random:goal=0,request=0,means=0,hidden=0,words=0,left=1";
    let mut by_left = false;
    for (seed, partner) in (1..=4).map(|seed| (seed, "synthetic")).chain([(4, left_handed)]) {
        let mut stages = Lockstep::new(&settings(seed, partner)).unwrap();
        let mut before = 0;
        while !stages.complete() && stages.ticks() < LONGEST {
            stages.step();
            by_left |=
                stages.truth.side == ArmSide::Left as u32 && stages.percept.hand.side == ArmSide::Left as u32;
            let now = stages.truth.achieved;
            for (index, subgoal) in stages.task().subgoals.iter().enumerate() {
                let new = now & !before & (1 << index) != 0;
                let ready = stages.task().is_available(index, before);
                assert!(!new || ready, "partner {seed}: {} came too early", subgoal.name);
            }
            before = now;
        }
        assert!(stages.complete(), "partner {seed}: only {before:09b} after {LONGEST} cycles");
        let all = stages.task().subgoals.len();
        assert_eq!(before.count_ones() as usize, all, "the robot knows what is true");
    }
    assert!(by_left, "nobody took anything with the left hand, or the robot did not notice");
}

#[test]
fn who_gets_the_next_part_ready_while_the_robot_mounts_is_not_corrected() {
    let mut prepared = 0;
    for seed in 1..=3 {
        let mut stages = Lockstep::new(&settings(seed, "active")).unwrap();
        let errors = stages.plan().layer(LayerKind::ErrorMonitoring).populations.clone();
        while !stages.complete() && stages.ticks() < LONGEST {
            stages.step();
            let Truth { held, .. } = *stages.truth;
            prepared += u32::from(held.iter().all(|parts| *parts != 0));
            let found = errors.clone().find(|error| stages.frame.signal[*error] > 0.5);
            let name = found.map(|error| stages.plan().populations[error].label.clone());
            assert_eq!(name, None, "partner {seed}, tick {}", stages.ticks());
        }
        assert!(stages.complete(), "partner {seed} is left alone");
    }
    assert!(prepared > 1000, "both had a part in their hands for {prepared} ms");
}

#[test]
fn of_alternatives_as_many_are_done_as_are_enough() {
    let task = configuration().join("tasks/tea.toml");
    let mut ways = BTreeSet::new();
    for seed in 1..=5 {
        let settings = RunSettings { task: task.clone(), ..settings(seed, "synthetic") };
        let mut stages = Lockstep::new(&settings).unwrap();
        while !stages.complete() && stages.ticks() < LONGEST {
            stages.step();
        }
        let achieved = stages.truth.achieved;
        assert!(stages.complete(), "partner {seed}: only {achieved:07b} after {LONGEST} cycles");
        for choice in &stages.task().choices {
            let done = choice.of.iter().filter(|&&goal| achieved & (1 << goal) != 0).count();
            assert_eq!(done, choice.count, "partner {seed}: {}", choice.name);
        }
        ways.insert(achieved);
    }
    assert!(ways.len() >= 3, "nobody chose: {ways:?}");
}

#[test]
fn same_seed_gives_the_same_bits() {
    let mut pair = [0, 1].map(|_| Lockstep::new(&settings(3, "synthetic")).unwrap());
    for _ in 0..20_000 {
        pair.iter_mut().for_each(Lockstep::step);
        let [one, other] = &pair;
        assert_eq!(
            bytemuck::bytes_of(&*one.command),
            bytemuck::bytes_of(&*other.command),
            "tick {}",
            one.ticks()
        );
    }
    let [one, other] = &pair;
    assert_eq!(bytemuck::bytes_of(&*one.frame), bytemuck::bytes_of(&*other.frame));
}
