//! The person's arm: where it is, how fast it moves, and how uncertain that is.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::Stage;
use coact_messages::{HandView, Keypoint, KeypointName, PersonArm, TrackedPoint};
use proptest::prelude::*;

fn distance(point: &TrackedPoint, place: [f64; 3]) -> f64 {
    (0..3).map(|axis| (point.position[axis] - place[axis]).powi(2)).sum::<f64>().sqrt()
}

fn shown(stage: &Stage, name: KeypointName) -> [f64; 3] {
    stage.sample.hands[0].keypoints[name as usize].position
}

#[test]
fn a_resting_arm_is_where_the_tracker_shows_it() {
    let stage = Stage::new();
    let arm = &stage.percept.arms[0];
    let names = [KeypointName::Shoulder, KeypointName::Elbow, KeypointName::Wrist, KeypointName::MiddleTip];
    assert!(arm.is_tracked() && arm.age < 20);
    for (point, name) in arm.points().into_iter().zip(names) {
        assert!(distance(point, shown(&stage, name)) < 1e-3, "{name:?}");
        assert!(point.deviation > 0.0 && point.deviation < 0.01, "{name:?}: {}", point.deviation);
        assert!(point.velocity.iter().all(|speed| speed.abs() < 1e-3), "{name:?}");
    }
}

#[test]
fn the_arm_ends_at_the_tip_of_the_longest_finger() {
    let mut stage = Stage::new();
    let [x, y, z] = shown(&stage, KeypointName::MiddleTip);
    let seen = |position| Keypoint { position, confidence: 0.9 };
    let stretched = [x + 0.05, y + 0.02, z];
    stage.wrong = vec![(KeypointName::IndexTip, seen(stretched))];
    stage.run(300, |_, _| {});
    assert!(distance(&stage.percept.arms[0].fingertip, stretched) < 2e-3);
    stage.wrong = vec![(KeypointName::IndexTip, Keypoint { position: stretched, confidence: 0.0 })];
    stage.run(300, |_, _| {});
    assert!(
        distance(&stage.percept.arms[0].fingertip, [x, y, z]) < 2e-3,
        "a finger that is not found is none"
    );
}

#[test]
fn a_moving_arm_is_where_it_is_now_and_not_where_the_last_frame_showed_it() {
    let mut stage = Stage::new();
    let (wheel, mut worst) = (stage.part("wheel"), [0.0_f64; 2]);
    stage.move_to(stage.grasping(wheel, 0), 550, |stage| {
        let arm = &stage.percept.arms[0];
        let [x, y, z] = stage.hand.centre;
        let (cosine, sine) = (stage.hand.pitch.cos(), stage.hand.pitch.sin());
        let wrist = [x - 0.15 * cosine, y, z - 0.15 * sine];
        worst[0] = worst[0].max(distance(&arm.wrist, wrist));
        worst[1] = worst[1].max(distance(&arm.wrist, wrist) / arm.wrist.deviation);
    });
    assert!(worst[0] < 0.03 && worst[1] < 5.0, "{worst:?}: off by more than its uncertainty explains");
}

#[test]
fn a_joint_that_is_lost_stays_where_it_was_and_becomes_uncertain_alone() {
    let mut stage = Stage::new();
    let before = stage.percept.arms[0];
    let elbow = shown(&stage, KeypointName::Elbow);
    stage.wrong = vec![(KeypointName::Elbow, Keypoint::default())];
    stage.run(400, |_, _| {});
    let arm = &stage.percept.arms[0];
    assert!(arm.is_tracked() && distance(&arm.elbow, elbow) < 1e-3);
    assert!(arm.elbow.deviation > 0.3 && arm.wrist.deviation < 2.0 * before.wrist.deviation);
}

#[test]
fn a_joint_that_was_never_seen_is_infinitely_uncertain() {
    let mut stage = Stage::empty();
    stage.run(10, |_, _| {});
    assert!(!stage.percept.arms[0].is_tracked() && stage.percept.arms[0].age == u64::MAX);
    assert!(stage.percept.arms[0].points().iter().all(|point| point.deviation == f64::INFINITY));
    stage.wrong =
        [KeypointName::Shoulder, KeypointName::Elbow].map(|name| (name, Keypoint::default())).into();
    stage.run(200, |_, _| {});
    let PersonArm { shoulder, elbow, wrist, .. } = stage.percept.arms[0];
    assert!(shoulder.deviation.is_infinite() && elbow.deviation.is_infinite() && wrist.deviation < 0.01);
    assert!(elbow.position.iter().all(|value| value.is_finite()));
}

#[test]
fn an_arm_that_is_not_seen_becomes_more_uncertain_with_every_cycle() {
    let mut stage = Stage::new();
    stage.move_to(stage.grasping(stage.part("wheel"), 0), 300, |_| {});
    stage.tracking = false;
    let mut last = stage.percept.arms[0];
    for cycle in 0..5000 {
        stage.run(1, |_, _| {});
        let arm = stage.percept.arms[0];
        for (now, before) in arm.points().into_iter().zip(last.points()) {
            assert!(now.deviation > before.deviation, "cycle {cycle}: {} m", now.deviation);
        }
        last = arm;
    }
    assert!(!last.is_tracked(), "five seconds ago");
    assert!(last.wrist.deviation > 9.0, "{} m: it may be anywhere", last.wrist.deviation);
}

#[test]
fn a_keypoint_that_the_tracker_hardly_believes_is_not_believed() {
    let mut stage = Stage::new();
    let before = stage.percept.arms[0].wrist;
    let doubtful = Keypoint { position: [0.0, 0.0, 1.0], confidence: 0.19 };
    stage.wrong = vec![(KeypointName::Wrist, doubtful)];
    stage.run(100, |_, _| {});
    assert!(distance(&stage.percept.arms[0].wrist, before.position) < 1e-3);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    /// Whatever bits the tracker delivers, and whenever: no number of the estimate but a deviation is ever infinite, and
    /// none is NaN.
    #[test]
    fn any_frame_leaves_the_estimate_finite(
        frames in prop::collection::vec(
            (prop::array::uniform32(any::<u64>()), any::<u8>(), 0_u64..60, any::<bool>()), 1..80
        )
    ) {
        let mut stage = Stage::new();
        for (bits, mask, wait, plausible_time) in frames {
            let value = |index: usize| f64::from_bits(bits[index % bits.len()]);
            let near = |index: usize| (value(index) % 1.0) * 3.0;
            let keypoint = |index: usize| {
                let wild = mask & (1 << (index % 8)) != 0;
                let of = |axis: usize| if wild { value(3 * index + axis) } else { near(3 * index + axis) };
                let confidence = if wild { value(index + 7) } else { 0.9 };
                Keypoint { position: std::array::from_fn(of), confidence }
            };
            stage.tick += wait;
            let captured_cycle = if plausible_time { stage.tick } else { bits[0] };
            let frame = stage.sample.hands[0].frame.wrapping_add(1);
            stage.sample.hands[0] = HandView { frame, captured_cycle, keypoints: std::array::from_fn(keypoint) };
            stage.perception.step(stage.tick, Some(&stage.sample), &mut stage.percept);
            stage.tick += 1;
            for point in stage.percept.arms[0].points() {
                prop_assert!(point.position.iter().chain(&point.velocity).all(|value| value.is_finite()));
                prop_assert!(point.deviation > 0.0, "{}", point.deviation);
            }
        }
    }
}
