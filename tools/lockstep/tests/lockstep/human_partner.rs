//! A person who does what people do besides the plan: both build the whole vehicle all the same.
#![allow(clippy::unwrap_used)]

use crate::shipped::settings;
use coact_lockstep::Lockstep;
use coact_period::cycles;
use coact_person::Holder;
use coact_pipeline::{RunSettings, WorldMode};
use std::time::Duration;

/// Time within which every assembly must be done.
const LONGEST: u64 = cycles(Duration::from_secs(300));

/// Builds until the vehicle stands, and calls `look` after each tick.
fn build(settings: &RunSettings, mut look: impl FnMut(&Lockstep)) {
    let mut stages = Lockstep::new(settings).unwrap();
    while !stages.complete() && stages.ticks() < LONGEST {
        stages.step();
        look(&stages);
    }
    let (seed, partner, achieved) = (settings.seed, &settings.partner, stages.truth.achieved);
    assert!(stages.complete(), "{partner}, seed {seed}: only {achieved:09b}");
}

/// How many parts that the person had taken were laid down again in an assembly.
fn returned(settings: &RunSettings) -> u32 {
    let (mut returned, mut held) = (0, 0_u64);
    build(settings, |stages| {
        let [now_robot, now_person] = stages.truth.held;
        let let_go = held & !now_person & !now_robot;
        let parts = stages.state.part[..stages.state.parts as usize].iter().enumerate();
        let lie =
            parts.filter(|(index, part)| let_go & (1 << index) != 0 && part.state == Holder::Nobody as u32);
        returned += lie.count() as u32;
        held = now_person;
    });
    returned
}

/// How many steps were undone in an assembly.
fn undone(settings: &RunSettings) -> u32 {
    let (mut undone, mut before) = (0, 0_u64);
    build(settings, |stages| {
        undone += (before & !stages.truth.achieved).count_ones();
        before = stages.truth.achieved;
    });
    undone
}

#[test]
fn what_the_person_takes_apart_is_built_again() {
    let partner = "random:undoes=0.3";
    assert!(undone(&settings(2, partner)) > 0);
    let physics = RunSettings { world: WorldMode::Physics, ..settings(3, partner) };
    assert!(undone(&physics) > 0);
}

#[test]
fn what_the_person_puts_back_is_taken_again() {
    let partner = "random:goal=0,withdraws=0,returns=0.5";
    let returned = [1, 2, 3].map(|seed| returned(&settings(seed, partner)));
    assert!(returned.iter().sum::<u32>() >= 2 * 3, "{returned:?}");
}

#[test]
fn who_hesitates_is_waited_for() {
    let partner = "random:goal=0,hidden=0,words=0,hesitates=1";
    let (mut hesitated, mut before) = (0, 0);
    build(&settings(1, partner), |stages| {
        hesitated += u32::from(stages.truth.hesitation_cycle > before);
        before = stages.truth.hesitation_cycle;
    });
    assert!(hesitated >= 2, "{hesitated}");
}
