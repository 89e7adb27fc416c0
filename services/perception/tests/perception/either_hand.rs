//! Both hands are seen; the one that sets out is the one that acts.
#![allow(clippy::unwrap_used)]

use super::support::{Hand, Stage, resting_on, smooth, stands_before};
use coact_joint_task::Act;
use coact_messages::{ArmSide, KeypointName, Percept};

const TOP: usize = 0;

/// Both hands at rest for two seconds, and a nut where the left one is nearer.
fn stage() -> (Stage, usize) {
    let mut stage = Stage::empty();
    stage.left = Some(resting_on(&stage.task, ArmSide::Left));
    let nut = stage.part("nut");
    stage.things[nut].position[..2].copy_from_slice(&[-0.98, 0.55]);
    stage.run(2000, |_, _| {});
    (stage, nut)
}

fn acting(percept: &Percept) -> ArmSide {
    ArmSide::BOTH[percept.hand.side as usize]
}

#[test]
fn a_reach_of_the_left_hand_is_understood_as_one_of_the_right_and_so_is_what_it_holds() {
    let (mut stage, nut) = stage();
    let kind = stage.kind("nut");
    let act = Act::Grasp { grip: TOP, kind };
    assert_eq!(acting(&stage.percept), ArmSide::Right);
    let (mut reached, mut most) = (false, 0.0_f64);
    let closed = stage.grasping(nut, TOP);
    stage.move_left_to(closed.open(), 700, |stage| {
        reached |= stage.percept.hand.reaching == 1 && stage.act(Act::Reach) > 0.9;
        most = most.max(stage.act(act));
        if stage.percept.hand.reaching == 1 {
            assert_eq!(acting(&stage.percept), ArmSide::Left);
        }
    });
    assert!(reached && most > 0.8, "{reached}, evidence of {most:.2}");
    assert!(stage.rival(act) < 0.5, "a rival has {:.2}", stage.rival(act));
    stage.move_left_to(closed, 100, |_| {});
    stage.run(150, |_, _| {});
    assert!(stage.percept.person_holds[kind] > 0.9, "closed on the part");
    let [right, left] = stage.percept.arms.map(|arm| arm.wrist.position);
    assert!(right[1] < 0.25 && left[1] > 0.45, "{right:?}, {left:?}");

    let rest = resting_on(&stage.task, ArmSide::Left);
    stage.run(100, |stage, _| stage.left.as_mut().unwrap().aperture = 0.1);
    stage.move_left_to(rest, 600, |_| {});
    stage.run(500, |_, _| {});
    assert!(stage.percept.person_holds[kind] < 0.1 && stage.act(act) < 0.1 && stage.act(Act::Rest) > 0.9);
    // And the other one again.
    let wheel = stage.part("wheel");
    stage.move_to(stage.grasping(wheel, TOP).open(), 700, |_| {});
    assert_eq!(acting(&stage.percept), ArmSide::Right);
    let act = Act::Grasp { grip: TOP, kind: stage.kind("wheel") };
    assert!(stage.act(act) > 0.8, "{:.2}", stage.act(act));
}

#[test]
fn a_hand_that_reaches_or_holds_something_is_not_left_for_the_other() {
    let (mut stage, nut) = stage();
    let (wheel, kind) = (stage.part("wheel"), stage.kind("wheel"));
    let (start, end) = (stage.hand, stage.grasping(wheel, TOP));
    let (left, left_end) = (stage.left.unwrap(), stage.grasping(nut, TOP));
    for time in 1..=1200_u64 {
        stage.hand = start.towards(&end.open(), smooth(time as f64 / 700.0));
        stage.hand = stage.hand.towards(&end, smooth((time as f64 - 550.0) / 150.0));
        stage.left = Some(left.towards(&left_end, smooth((time as f64 - 350.0) / 700.0)));
        stage.run(1, |_, _| {});
        assert_eq!(acting(&stage.percept), ArmSide::Right, "{time}");
    }
    assert!(stage.percept.person_holds[kind] > 0.9);
    let arm = &stage.percept.arms[ArmSide::Left as usize];
    assert!(arm.is_tracked() && (arm.fingertip.position[1] - 0.55).abs() < 0.05, "{arm:?}");
}

#[test]
fn a_hand_that_is_held_out_open_is_not_left_for_the_other() {
    let (mut stage, nut) = stage();
    let gesture = stage.task.acts.iter().find(|act| matches!(act, Act::Gesture(_))).copied().unwrap();
    let [x, y, z] = stage.task.scene.handover;
    let out = Hand { centre: [x - 0.10, y, z], pitch: stage.task.gestures[0].pitch, aperture: 0.11 };
    stage.move_to(out, 800, |_| {});
    stage.run(400, |_, _| {});
    assert!(stage.act(gesture) > 0.8, "{:.2}", stage.act(gesture));
    stage.move_left_to(stage.grasping(nut, TOP), 700, |stage| {
        assert_eq!(acting(&stage.percept), ArmSide::Right);
        assert!(stage.act(gesture) > 0.8, "{:.2}", stage.act(gesture));
    });
}

#[test]
fn the_other_hand_that_rests_sways_or_is_lost_changes_nothing() {
    let (mut stage, _) = stage();
    let left = stage.left.unwrap();
    stage.run(600, |stage, time| {
        let aside = 0.02 * (time as f64 / 100.0).sin();
        stage.left = Some(Hand { centre: [left.centre[0], left.centre[1] + aside, left.centre[2]], ..left });
    });
    stage.run(600, |stage, _| stage.left = None);
    assert_eq!(acting(&stage.percept), ArmSide::Right);
    assert!(stage.act(Act::Rest) > 0.95 && stage.act(Act::Hidden) < 0.05);
    let [right, left] = &stage.percept.arms;
    assert!(right.is_tracked() && !left.is_tracked() && left.age > 500);
}

#[test]
fn the_left_hand_that_sets_out_of_sight_is_on_a_hidden_reach() {
    for stands in [true, false] {
        let (mut stage, _) = stage();
        let mut ahead = stage.left.unwrap().centre;
        ahead[0] += 0.02;
        if stands {
            stands_before(&stage.task, &mut stage.sample.scene.surface, ahead, 0.4);
        }
        stage.run(100, |_, _| {});
        stage.run(200, |stage, _| stage.left = None);
        let hidden = stage.act(Act::Hidden);
        assert_eq!(hidden > 0.9, stands, "{hidden:.2}");
        assert_eq!(acting(&stage.percept), if stands { ArmSide::Left } else { ArmSide::Right });
    }
}

#[test]
fn a_resting_hand_whose_fingers_are_hidden_has_not_set_out() {
    let (mut stage, nut) = stage();
    let mut ahead = stage.left.unwrap().centre;
    ahead[0] += 0.02;
    stands_before(&stage.task, &mut stage.sample.scene.surface, ahead, 0.4);
    let fingers = [KeypointName::ThumbTip, KeypointName::IndexTip, KeypointName::MiddleTip];
    stage.lost_left = fingers.to_vec();
    stage.run(1000, |stage, _| {
        assert_eq!(acting(&stage.percept), ArmSide::Right);
        assert!(stage.act(Act::Hidden) < 0.05);
    });
    let left = &stage.percept.arms[ArmSide::Left as usize];
    assert!(left.wrist.age < 50 && left.fingertip.age > 800, "its wrist is followed: {left:?}");
    // Nor is it the one that acts when the right one does.
    let kind = stage.kind("nut");
    let closed = stage.grasping(nut, TOP);
    stage.move_to(closed.open(), 700, |_| {});
    stage.move_to(closed, 100, |_| {});
    stage.run(150, |_, _| {});
    assert_eq!(acting(&stage.percept), ArmSide::Right);
    assert!(stage.percept.person_holds[kind] > 0.9);
}

#[test]
fn a_hand_that_is_seen_away_from_its_rest_acts_rather_than_one_that_is_not_seen() {
    let (mut stage, nut) = stage();
    let (wheel, kind) = (stage.part("wheel"), stage.kind("wheel"));
    stage.move_left_to(stage.grasping(nut, TOP).open(), 700, |_| {});
    assert_eq!(acting(&stage.percept), ArmSide::Left);
    // Meanwhile the right one takes a part, and holds it out; of the left one nothing is seen any more.
    stage.things[wheel].position = [-0.75, 0.10, 0.95];
    stage.hand = stage.grasping(wheel, TOP);
    stage.run(200, |_, _| {});
    stage.run(5000, |stage, _| stage.left = None);
    assert_eq!(acting(&stage.percept), ArmSide::Right);
    assert!(stage.percept.person_holds[kind] > 0.9);
}
