//! Pro-active behaviour and goal inference (chapter, section 5.1), from the sensors to the moving arm: the script
//! drives the person only.
#![allow(clippy::unwrap_used)]

use crate::shipped::{configuration, decision, settings};
use coact_lockstep::Lockstep;
use coact_messages::PartnerPhase;
use coact_period::{CYCLES_PER_SECOND, cycles};
use std::time::Duration;

/// Runs until the person's `action`-th action (from 1) has come to `phase`, at most a minute.
fn run_until(stages: &mut Lockstep, action: u32, phase: PartnerPhase) {
    while (stages.truth.actions, stages.truth.phase) != (action, phase as u32) {
        stages.step();
        assert!(
            stages.ticks() < 60 * CYCLES_PER_SECOND,
            "the person never came to {phase:?} of action {action}"
        );
    }
}

fn run_for(stages: &mut Lockstep, ticks: u64) {
    (0..ticks).for_each(|_| stages.step());
}

#[test]
fn the_robot_asks_helps_asks_again_and_receives() {
    let script = format!("script:{}", configuration().join("scenarios/proactive.toml").display());
    let mut stages = Lockstep::new(&settings(1, &script)).unwrap();

    run_for(&mut stages, 5 * CYCLES_PER_SECOND);
    assert_eq!(decision(&stages), Some("request: wheel on the robot's side"), "the person idles");

    run_until(&mut stages, 1, PartnerPhase::Transport);
    run_for(&mut stages, cycles(Duration::from_millis(200)));
    assert_eq!(decision(&stages), Some("steady the base: wheel on the person's side"), "a grip from above");

    run_until(&mut stages, 1, PartnerPhase::Idle);
    run_for(&mut stages, 5 * CYCLES_PER_SECOND);
    assert_eq!(stages.truth.achieved, 0b1, "the person's wheel is mounted");
    assert_eq!(decision(&stages), Some("request: wheel on the robot's side"), "the person idles again");

    run_until(&mut stages, 2, PartnerPhase::Transport);
    run_for(&mut stages, cycles(Duration::from_millis(200)));
    assert_eq!(decision(&stages), Some("receive: wheel on the robot's side"), "a grip from the side");

    run_for(&mut stages, 9 * CYCLES_PER_SECOND);
    assert_eq!(stages.truth.achieved, 0b11, "the robot has mounted the wheel that it was given");
}
