//! Forward and inverse kinematics agree on the robot of `rt-config/robots`.
#![allow(clippy::unwrap_used)]

use coact_robot::{Posture, Robot};
use nalgebra::{Isometry3, Vector3};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::LazyLock;

static ROBOT: LazyLock<Robot> = LazyLock::new(|| {
    Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/robots/aros.toml")).unwrap()
});

/// A posture anywhere within the limits.
fn posture() -> impl Strategy<Value = Posture> {
    prop::array::uniform7(0.0..1.0f64).prop_map(|fraction| {
        std::array::from_fn(|joint| {
            let limits = ROBOT.arm().joints[joint].limits;
            limits.lower + fraction[joint] * (limits.upper - limits.lower)
        })
    })
}

fn distance(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    let turn = a.rotation.to_rotation_matrix().matrix() - b.rotation.to_rotation_matrix().matrix();
    (a.translation.vector - b.translation.vector).norm().max(turn.norm())
}

/// Between two angles, the shorter way around, rad.
fn between(a: f64, b: f64) -> f64 {
    ((a - b + PI).rem_euclid(TAU) - PI).abs()
}

proptest! {
    #[test]
    fn every_solution_reaches_the_pose_within_the_limits(posture in posture(), swivel in -3.2..3.2) {
        let palm = ROBOT.palm(&posture);
        for solution in ROBOT.kinematics.solve(&palm, swivel, 0.0).as_slice() {
            prop_assert!(distance(&ROBOT.palm(solution), &palm) < 1e-9);
            prop_assert!(ROBOT.arm().within_limits(solution, 0.0));
        }
    }

    #[test]
    fn a_reachable_pose_is_found_for_some_swivel(posture in posture()) {
        // Near the straight arm and the aligned wrist single joints turn fast with the swivel.
        let elbow_and_wrist = posture[1].abs().min(posture[3].abs()).min(posture[5].abs());
        prop_assume!(elbow_and_wrist > 0.02);
        let between_swivels = 0.01 / elbow_and_wrist;
        let palm = ROBOT.palm(&posture);
        let nearest = (0..720)
            .flat_map(|step| {
                // A posture at a limit lies between two swivels, and at one of them beyond it.
                let swivel = f64::from(step) * 0.5f64.to_radians();
                ROBOT.kinematics.solve(&palm, swivel, -between_swivels).as_slice().to_vec()
            })
            .map(|found| (0..7).map(|joint| between(found[joint], posture[joint])).fold(0.0, f64::max))
            .fold(f64::INFINITY, f64::min);
        prop_assert!(nearest < between_swivels, "nearest {nearest}");
    }
}

#[test]
fn the_straight_arm_points_along_its_base_axis() {
    let palm = ROBOT.palm(&[0.0; 7]);
    let expected = Vector3::new(0.0, 0.045 + 0.340 + 0.395 + 0.369 + 0.246, 1.5);
    assert!((palm.translation.vector - expected).norm() < 1e-9, "{palm}");
    assert!((palm.rotation * Vector3::z() - Vector3::y()).norm() < 1e-9);
}

#[test]
fn the_singular_postures_are_solved_too() {
    for posture in [[0.0; 7], [0.3, 0.0, 0.2, -0.5, 0.4, 0.0, 0.1], [0.3, -0.4, 0.2, 0.0, 0.4, 0.6, 0.1]] {
        let palm = ROBOT.palm(&posture);
        let found: usize = (0..72)
            .map(|step| {
                let found = ROBOT.kinematics.solve(&palm, f64::from(step) * 5f64.to_radians(), 0.0);
                assert!(
                    found.as_slice().iter().all(|solution| distance(&ROBOT.palm(solution), &palm) < 1e-7)
                );
                found.as_slice().len()
            })
            .sum();
        // The straight arm's distance may round to just beyond reach.
        assert!(found > 0 || posture[3] == 0.0, "{posture:?}");
    }
}

#[test]
fn beyond_reach_there_is_no_solution() {
    let far = Isometry3::translation(-2.0, 0.3, 1.0);
    assert!(
        (0..72).all(|step| ROBOT.kinematics.solve(&far, f64::from(step) * 0.1, 0.0).as_slice().is_empty())
    );
}

#[test]
fn the_hand_closes_on_a_width() {
    for width in [0.02, 0.025, 0.055, 0.075, 0.11] {
        let base = ROBOT.hand.base_for_width(width);
        assert!((ROBOT.hand.width(base) - width).abs() < 1e-9);
        let ends = ROBOT.hand.ends(&ROBOT.hand.posture(base));
        for end in ends {
            assert!(
                (end.z - ROBOT.hand.grasp_distance).abs() < 0.015,
                "the ends meet near the grasp point: {end}"
            );
        }
    }
    assert!(ROBOT.hand.width(0.5) > ROBOT.hand.width(1.0), "larger angles close");
}
