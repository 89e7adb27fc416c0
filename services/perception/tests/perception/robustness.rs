//! Whatever arrives, or does not arrive, and whenever perception dies.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::{self, Stage, perception, resting};
use bytemuck::bytes_of;
use coact_joint_task::Act;
use coact_messages::{HandView, Keypoint, KeypointName, Percept, SceneView};

const TOP: usize = 0;

/// Reaches for a wheel, carries it off and comes back; `watch` is called after each cycle.
fn episode(stage: &mut Stage, mut watch: impl FnMut(&mut Stage)) {
    let wheel = stage.part("wheel");
    stage.move_to(stage.grasping(wheel, TOP), 550, |_| {});
    let ways = [(stage.grasping(wheel, TOP), 550), (resting(&stage.task), 600)];
    for (end, ticks) in ways {
        let start = stage.hand;
        for time in 1..=ticks {
            stage.hand = start.towards(&end, support::smooth(time as f64 / ticks as f64));
            stage.run(1, |_, _| {});
            watch(stage);
        }
    }
}

#[test]
fn the_same_samples_make_the_same_bits() {
    let record = || {
        let mut stage = Stage::new();
        let mut all: Vec<u8> = Vec::new();
        episode(&mut stage, |stage| all.extend_from_slice(bytes_of(&*stage.percept)));
        all
    };
    assert!(record() == record());
}

#[test]
fn a_replacement_goes_on_as_if_nothing_had_happened() {
    let (mut whole, mut killed) = (Stage::new(), Stage::new());
    let mut expected: Vec<Percept> = Vec::new();
    episode(&mut whole, |stage| expected.push(*stage.percept));
    let mut at = 0;
    episode(&mut killed, |stage| {
        assert!(bytes_of(&*stage.percept) == bytes_of(&expected[at]), "cycle {at}");
        if at % 97 == 0 {
            stage.perception = perception(&stage.task);
            stage.perception.resume(&stage.percept).unwrap();
        }
        at += 1;
    });
    assert_eq!(at, expected.len());
}

#[test]
fn a_percept_that_perception_did_not_leave_is_refused_with_the_reason() {
    let stage = Stage::new();
    let refused = |change: fn(&mut Percept)| {
        let mut percept = *stage.percept;
        change(&mut percept);
        stage.perception.clone().resume(&percept).unwrap_err().to_string()
    };
    let foreign = refused(|percept| percept.state.fill(0.0));
    assert!(foreign.contains("hold no state of perception"), "{foreign}");
    let evidence = refused(|percept| percept.act[3] = f64::NAN);
    assert!(evidence.starts_with("act is implausible, expected evidence between 0 and 1"), "{evidence}");
    let damaged = refused(|percept| percept.state[30] = 1e9);
    assert!(damaged.contains("hand.keypoint"), "{damaged}");
}

#[test]
fn whichever_word_of_the_state_is_damaged_perception_refuses_it_or_goes_on() {
    let mut stage = Stage::new();
    stage.move_to(stage.grasping(stage.part("wheel"), TOP), 400, |_| {});
    let (last, sound) = (*stage.percept, stage.perception.clone());
    for word in 0..last.state.len() {
        for bits in [u64::MAX, 1, 1 << 40, 1e300_f64.to_bits(), (-1.0_f64).to_bits()] {
            let mut percept = last;
            percept.state[word] = f64::from_bits(bits);
            stage.perception = sound.clone();
            if stage.perception.resume(&percept).is_ok() {
                stage.run(40, |_, _| {});
                assert_sound(&stage.percept);
            }
        }
    }
}

fn assert_sound(percept: &Percept) {
    let evidence =
        [&percept.act[..], &percept.achieved, &percept.open, &percept.robot_holds, &percept.person_holds];
    let seen = percept.workspace.iter().flat_map(|place| place.seen.iter().chain(&place.gone));
    for value in evidence.into_iter().flatten().chain(seen) {
        assert!((0.0..=1.0).contains(value), "evidence of {value}");
    }
    let hand = percept.hand;
    let points = percept.arms.iter().flat_map(|arm| arm.points());
    let arms = points.flat_map(|point| point.position.iter().chain(&point.velocity));
    let numbers = arms.chain([&hand.aperture]);
    let positions = percept.workspace.iter().flat_map(|place| place.position.iter().flatten());
    assert!(numbers.chain(positions).all(|value| value.is_finite()));
}

#[test]
fn garbage_makes_no_garbage() {
    let bad = [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300, -1e300, f64::MIN_POSITIVE, 0.0];
    let mut stage = Stage::new();
    for round in 0..4000_usize {
        let pick = |offset: usize| bad[(round / 3 + offset) % bad.len()];
        stage.run(1, |_, _| {});
        stage.sample.joints.touch = pick(1);
        stage.sample.hands[0] = HandView {
            frame: round as u64 * 7,
            captured_cycle: if round % 5 == 0 { u64::MAX } else { stage.tick },
            keypoints: std::array::from_fn(|point| Keypoint {
                position: std::array::from_fn(|axis| pick(point + axis)),
                confidence: pick(point),
            }),
        };
        let scene: &mut SceneView = &mut stage.sample.scene;
        scene.frame = round as u64 * 3;
        scene.captured_cycle = if round % 7 == 0 { u64::MAX } else { stage.tick };
        scene.sightings = u32::MAX;
        scene.obstacles = u32::MAX;
        scene.surface.grid.sites = [round as u32, u32::MAX];
        scene.surface.level = pick(3);
        for (index, sighting) in scene.sighting.iter_mut().enumerate() {
            sighting.kind = (index as u32).wrapping_mul(0x9E37_79B9);
            sighting.position = std::array::from_fn(|axis| pick(index + axis));
            sighting.orientation = std::array::from_fn(|axis| pick(index + 2 * axis));
        }
        stage.perception.step(stage.tick, Some(&stage.sample), &mut stage.percept);
        stage.tick += 1;
        assert_sound(&stage.percept);
    }
}

#[test]
fn without_any_sample_nothing_is_seen() {
    let mut stage = Stage::empty();
    for tick in 1..100 {
        stage.perception.step(tick, None, &mut stage.percept);
        assert_sound(&stage.percept);
    }
    assert!(!stage.percept.arms[0].is_tracked());
    assert!(stage.percept.act.iter().all(|value| *value == 0.0));
}

#[test]
fn a_gap_in_the_tracking_is_bridged_and_a_long_one_is_told() {
    let act = |stage: &Stage| stage.act(Act::Grasp { grip: TOP, kind: stage.kind("wheel") });
    let reach = |gap: std::ops::Range<u64>| {
        let mut stage = Stage::new();
        let end = stage.grasping(stage.part("wheel"), TOP);
        let start = stage.hand;
        stage.run(560, |stage, time| {
            stage.tracking = !gap.contains(&time);
            stage.hand = start.towards(&end, support::smooth(time as f64 / 600.0));
        });
        stage
    };
    let (clean, gappy) = (reach(0..0), reach(330..430));
    assert!(act(&gappy) > 0.8 * act(&clean), "{:.2} instead of {:.2}", act(&gappy), act(&clean));

    let mut lost = reach(400..560);
    lost.run(400, |stage, _| stage.tracking = false);
    assert!(!lost.percept.arms[0].is_tracked());
    assert!(lost.percept.arms[0].age > 400 && act(&lost) < 0.05);
}

#[test]
fn a_lost_keypoint_is_held() {
    let mut stage = Stage::new();
    let before = stage.percept.hand.aperture;
    stage.wrong = vec![(KeypointName::ThumbTip, Keypoint::default())];
    stage.run(100, |_, _| {});
    assert!((stage.percept.hand.aperture - before).abs() < 1e-3);
}

#[test]
fn a_stale_sample_ages() {
    let mut stage = Stage::new();
    let rest = stage.act(Act::Rest);
    for _ in 0..600 {
        stage.perception.step(stage.tick, Some(&stage.sample), &mut stage.percept);
        stage.tick += 1;
    }
    assert!(rest > 0.9 && stage.act(Act::Rest) < 0.05 && !stage.percept.arms[0].is_tracked());
}
