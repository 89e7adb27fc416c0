//! The working robot beside an arm that moves as it was recorded.
#![allow(clippy::unwrap_used)]

use coact_evaluation::{Encounters, encounter};
use coact_pipeline::{RunSettings, WorldMode};
use coact_recordings::ArmSide;
use std::fmt::Write as _;
use std::path::Path;

/// Motion capture of a right arm that reaches ahead and comes back, six seconds of it.
fn recording() -> tempfile::NamedTempFile {
    let mut text = String::from("t_s");
    for body in ["right_shoulder", "right_elbow", "right_hand"] {
        write!(text, ",{body}.x_mm,{body}.y_mm,{body}.z_mm").unwrap();
    }
    for frame in 0..600 {
        let time = f64::from(frame) * 0.01;
        let reach = 200.0 * (1.0 - (1.5 * time).cos());
        write!(text, "\n{time:.2},200,0,500,300,{:.1},300,250,{:.1},250", 0.5 * reach, 200.0 + reach)
            .unwrap();
    }
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), text + "\n").unwrap();
    file
}

#[test]
fn the_robot_works_beside_the_arm_and_what_happens_depends_on_the_seed_alone() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let settings = RunSettings { seed: 3, world: WorldMode::Kinematic, ..RunSettings::shipped(&folder) };
    let file = recording();
    let arms = [(file.path().to_owned(), ArmSide::Right)];
    let run = |threads| {
        encounter(&Encounters { settings: &settings, arms: &arms, count: 3, threads }, || {}).unwrap()
    };
    let encounters = run(2);
    assert_eq!(encounters, run(1));
    assert_eq!(encounters.iter().map(|one| one.seed).collect::<Vec<_>>(), [3, 4, 5]);
    for one in &encounters {
        assert!(one.robot_moved() && one.moved_ms < 6_000, "{one:?}");
        assert_eq!(one.handover_ms, 0, "{one:?}");
        assert!(one.separation.nearest_m.is_some_and(|nearest| nearest < 0.5), "{one:?}");
    }
}
