//! A part that the robot loses is told, and nothing else is taken for a loss.
#![allow(clippy::unwrap_used)]

use crate::shipped::settings;
use coact_lockstep::Lockstep;
use coact_period::CYCLES_PER_SECOND;

/// Ticks with evidence of a loss, and the most subgoals achieved at a time, in so many seconds: a new assembly follows one that is complete.
fn watch(seed: u64, partner: &str, seconds: u64) -> (u64, u32) {
    let mut stages = Lockstep::new(&settings(seed, partner)).unwrap();
    let (mut lost, mut achieved) = (0, 0);
    for _ in 0..seconds * CYCLES_PER_SECOND {
        stages.step();
        lost += u64::from(stages.percept.lost.iter().any(|evidence| *evidence > 0.0));
        achieved = achieved.max(stages.truth.achieved.count_ones());
    }
    (lost, achieved)
}

#[test]
fn releasing_handing_over_and_mounting_are_no_loss() {
    for seed in 1..4 {
        let (lost, achieved) = watch(seed, "synthetic", 50);
        assert_eq!(lost, 0, "seed {seed}");
        assert!(achieved > 3, "seed {seed}: only {achieved} subgoals");
    }
}

#[test]
fn a_part_that_slips_out_of_the_fingers_is_lost_for_some_seconds() {
    let scenario = format!("script:{}/../../rt-config/scenarios/lost-part.toml", env!("CARGO_MANIFEST_DIR"));
    let (lost, _) = watch(1, &scenario, 20);
    assert!((500..3500).contains(&lost), "{lost} ticks");
}
