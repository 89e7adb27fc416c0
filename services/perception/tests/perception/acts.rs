//! What the hand does is seen while it does it, in proportion, and nothing else is seen in it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::{self, Hand, Stage, resting, stands_before};
use coact_joint_task::Act;
use coact_messages::{Keypoint, KeypointName};

/// Keypoints of the hand but its wrist.
const HAND: [KeypointName; 6] = [
    KeypointName::PalmBase,
    KeypointName::ThumbTip,
    KeypointName::IndexKnuckle,
    KeypointName::IndexTip,
    KeypointName::MiddleTip,
    KeypointName::LittleKnuckle,
];
const TOP: usize = 0;
const SIDE: usize = 1;

#[test]
fn a_clean_reach_grows_into_the_right_grasp_and_no_other() {
    for (name, grip) in [("wheel", TOP), ("wheel", SIDE), ("column 1", SIDE)] {
        let mut stage = Stage::new();
        let act = Act::Grasp { grip, kind: stage.kind(name) };
        let mut seen = Vec::new();
        let mut rivals = 0.0_f64;
        let end = stage.grasping(stage.part(name), grip);

        stage.move_to(end, 600, |stage| {
            seen.push(stage.act(act));
            rivals = rivals.max(stage.rival(act));
        });

        let drop = seen[..540].windows(60).map(|window| window[0] - window[59]).fold(0.0, f64::max);
        assert!(seen[480] > 0.6, "{name}: {:.2} at 80 % of the reach", seen[480]);
        assert!(drop < 0.3, "{name}: evidence fell by {drop:.2} on the way");
        assert!(seen[60] < 0.2, "{name}: {:.2} before the movement shows anything", seen[60]);
        // Of a single frame: the destination field takes its time.
        assert!(rivals < 0.7, "{name}: a rival had {rivals:.2}");
    }
}

#[test]
fn a_hand_that_turns_about_its_wrist_to_what_lies_beside_reaches_for_it() {
    let mut stage = Stage::new();
    let lay = stage.sample.hands[0].keypoints;
    let [x, y, _] = lay[KeypointName::Wrist as usize].position;
    let turned = |keypoint: Keypoint, angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        let (ahead, aside) = (keypoint.position[0] - x, keypoint.position[1] - y);
        let position =
            [x + cosine * ahead - sine * aside, y + sine * ahead + cosine * aside, keypoint.position[2]];
        Keypoint { position, ..keypoint }
    };
    let (part, column) = (stage.part("column 1"), stage.kind("column 1"));
    let [thumb, index] =
        [KeypointName::ThumbTip, KeypointName::IndexTip].map(|name| turned(lay[name as usize], 1.2).position);
    let middle: [f64; 3] = std::array::from_fn(|axis| 0.5 * (thumb[axis] + index[axis]));
    stage.things[part].position = [middle[0], middle[1], stage.task.scene.table_height];
    stage.run(500, |_, _| {});
    let (mut reach, mut way) = (0.0_f64, 0.0_f64);
    for time in 1..=600 {
        let angle = 1.2 * support::smooth(f64::from(time) / 600.0);
        stage.wrong = HAND.map(|name| (name, turned(lay[name as usize], angle))).to_vec();
        stage.run(1, |_, _| {});
        reach = reach.max(stage.act(Act::Reach));
        way = way.max(stage.on_the_way(column));
    }
    assert!(reach > 0.9, "{reach}");
    assert!(way > 0.5, "{way}");
}

#[test]
fn what_the_robot_still_holds_in_its_place_is_there_to_be_taken() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("wheel"), stage.kind("wheel"));
    let handover = stage.task.scene.handover;
    let away = |place: [f64; 3]| (0..3).map(|axis| (place[axis] - handover[axis]).powi(2)).sum::<f64>();
    let sockets = stage.task.subgoals.iter().filter(|goal| goal.kind == kind).map(|goal| goal.socket);
    let socket = sockets.min_by(|one, other| away(*one).total_cmp(&away(*other))).unwrap();
    let lay = stage.things[part].position;
    stage.run(1500, |stage, time| {
        let (up, along) = (support::smooth(time as f64 / 500.0), support::smooth(time as f64 / 1000.0 - 0.5));
        let [x, y, z]: [f64; 3] = std::array::from_fn(|axis| lay[axis] + along * (socket[axis] - lay[axis]));
        stage.things[part].position = [x, y, z + 0.2 * (up - along)];
        stage.sample.joints.touch = 5.0;
    });
    assert!(stage.percept.robot_holds[kind] > 0.9);
    let end = stage.grasping(part, TOP);
    stage.move_to(end, 600, |_| {});
    let there = |place: [f64; 2]| (place[0] - socket[0]).hypot(place[1] - socket[1]) < 0.01;
    let kinds: Vec<_> =
        stage.percept.destinations.iter().filter(|(_, place, _)| there(*place)).map(|own| own.0).collect();
    assert_eq!(kinds, [Some(kind)]);
}

#[test]
fn evidence_is_graded() {
    let mut levels = std::collections::BTreeSet::new();
    // Frames come at other phases of the reach in each.
    for later in [0, 4, 8, 12] {
        let mut stage = Stage::new();
        let act = Act::Grasp { grip: TOP, kind: stage.kind("wheel") };
        let end = stage.grasping(stage.part("wheel"), TOP);
        stage.run(later, |_, _| {});
        stage.move_to(end, 600, |stage| {
            levels.insert((stage.act(act) * 20.0) as u32);
        });
    }
    assert!(levels.len() > 14, "only {} of 20 levels were passed through", levels.len());
}

#[test]
fn idling_grows_with_the_seconds_and_ends_with_the_first_movement() {
    let mut stage = Stage::empty();
    stage.run(1700, |_, _| {});
    let early = stage.act(Act::Idle);
    stage.run(2000, |_, _| {});
    assert!((0.4..0.6).contains(&early), "{early:.2} after about one and a half seconds");
    assert!(stage.act(Act::Idle) > 0.95 && stage.act(Act::Rest) > 0.95);

    let end = stage.grasping(stage.part("wheel"), TOP);
    let mut reaching = false;
    stage.move_to(end, 500, |stage| {
        reaching |= stage.percept.hand.reaching == 1 && stage.act(Act::Reach) > 0.9
    });
    assert!(reaching);
    assert!(stage.act(Act::Idle) < 0.05 && stage.act(Act::Rest) < 0.05);
}

#[test]
fn a_hand_that_goes_out_of_sight_as_it_sets_out_is_on_a_hidden_reach() {
    // Something stands beside the resting hand, or does not; the hand comes from rest, or has been elsewhere.
    for (stands, from_rest) in [(true, true), (false, true), (true, false)] {
        let mut stage = Stage::new();
        if !from_rest {
            let mut elsewhere = stage.hand;
            elsewhere.centre[1] += 0.3;
            stage.move_to(elsewhere, 600, |_| {});
            stage.run(1000, |_, _| {});
        }
        let mut ahead = stage.hand.centre;
        ahead[0] += 0.02;
        if stands {
            stands_before(&stage.task, &mut stage.sample.scene.surface, ahead, 0.4);
        }
        stage.run(100, |_, _| {});
        assert!(stage.act(Act::Hidden) < 0.05, "it is seen");
        stage.run(200, |stage, _| stage.tracking = false);
        let hidden = stage.act(Act::Hidden);
        assert_eq!(hidden > 0.9, stands && from_rest, "{stands}, {from_rest}: {hidden:.2}");
        assert!(!(0.05..0.9).contains(&hidden), "{hidden:.2}");
    }
}

#[test]
fn a_part_in_the_hand_is_held_until_the_hand_leaves_it() {
    let mut stage = Stage::new();
    let (wheel, kind) = (stage.part("wheel"), stage.kind("wheel"));
    let act = Act::Grasp { grip: TOP, kind };
    let closed = stage.grasping(wheel, TOP);
    stage.move_to(closed.open(), 600, |_| {});
    stage.move_to(closed, 100, |_| {});
    stage.run(150, |_, _| {});
    assert!(stage.percept.person_holds[kind] > 0.9, "closed on the part");

    let mut carried = stage.grasping(wheel, TOP);
    carried.centre = [-0.75, 0.30, 0.90];
    let offset = stage.things[wheel].position[2] - stage.hand.centre[2];
    let start = stage.hand;
    let mut least = 1.0_f64;
    stage.run(900, |stage, time| {
        stage.hand = start.towards(&carried, support::smooth(time as f64 / 800.0));
        let [x, y, z] = stage.hand.centre;
        stage.things[wheel].position = [x, y, z + offset];
        least = least.min(stage.act(act));
    });
    assert!(least > 0.8, "evidence fell to {least:.2} while the part was carried");

    let rest = resting(&stage.task);
    stage.move_to(rest, 600, |_| {});
    stage.run(200, |_, _| {});
    assert!(stage.percept.person_holds[kind] < 0.1 && stage.act(act) < 0.1);
}

#[test]
fn a_grip_that_was_out_of_sight_shows_when_the_hand_comes_back() {
    let mut stage = Stage::new();
    let wheel = stage.part("wheel");
    stage.run(900, |stage, _| stage.tracking = false);
    let taken = stage.grasping(wheel, TOP);
    let held = Hand { centre: [-0.75, 0.30, 0.95], ..taken };
    stage.things[wheel].position[2] += held.centre[2] - taken.centre[2];
    (stage.things[wheel].position[0], stage.things[wheel].position[1]) = (held.centre[0], held.centre[1]);
    (stage.hand, stage.tracking) = (held, true);
    let knuckles = [KeypointName::IndexKnuckle, KeypointName::LittleKnuckle];
    stage.wrong = knuckles.map(|name| (name, bytemuck::Zeroable::zeroed())).to_vec();
    stage.run(150, |_, _| {});
    let act = Act::Grasp { grip: TOP, kind: stage.kind("wheel") };
    assert!(stage.percept.person_holds[stage.kind("wheel")] > 0.9);
    stage.wrong.clear();
    stage.run(100, |_, _| {});
    assert!(stage.act(act) > 0.9, "{:.2}", stage.act(act));
}

#[test]
fn a_hand_that_comes_to_rest_over_a_part_has_not_taken_it() {
    for aperture in [0.02, 0.03, 0.04] {
        let mut stage = Stage::new();
        let (nut, kind) = (stage.part("nut"), stage.kind("nut"));
        let over = Hand { aperture, ..stage.grasping(nut, TOP) };
        let [x, y, z] = over.centre;
        let away = Hand { centre: [x, y + 0.4, z + 0.1], aperture: 0.08, ..over };
        stage.move_to(away, 600, |_| {});
        stage.run(600, |_, _| {});
        stage.move_to(over, 700, |_| {});
        let mut most = 0.0_f64;
        stage.run(10_000, |stage, _| most = most.max(stage.percept.person_holds[kind]));
        assert!(most < 0.05, "{aperture} m wide: {most:.2}");
        // Nobody is there to see how its fingers closed.
        stage.run(500, |stage, _| stage.tracking = false);
        stage.run(500, |stage, _| stage.tracking = true);
        assert!(stage.percept.person_holds[kind] > 0.9);
    }
}

#[test]
fn what_hangs_in_the_air_between_fingers_is_held_by_them() {
    let mut stage = Stage::new();
    let (nut, kind) = (stage.part("nut"), stage.kind("nut"));
    stage.things[nut].position = [-0.75, 0.30, 0.95];
    stage.hand = stage.grasping(nut, TOP);
    stage.run(600, |_, _| {});
    assert!(stage.percept.person_holds[kind] > 0.9, "nobody saw how they closed");
}

#[test]
fn withdrawing_over_the_parts_looks_like_no_grasp() {
    let mut stage = Stage::new();
    stage.hand = Hand { centre: [-0.70, 0.35, 0.95], pitch: -0.5, aperture: 0.08 };
    stage.run(800, |_, _| {});
    let rest = resting(&stage.task);
    let mut most = 0.0_f64;
    stage.move_to(rest, 600, |stage| {
        most = most.max(stage.rival(Act::Rest));
        assert_eq!(stage.percept.hand.reaching, 0, "a withdrawal is no reach");
    });
    assert!(most < 0.4, "evidence of {most:.2} for a grasp");
}

#[test]
fn an_open_hand_held_out_is_the_gesture() {
    let mut stage = Stage::new();
    let [x, y, z] = stage.task.scene.handover;
    let open = Hand { centre: [x - 0.08, y, z], pitch: 0.0, aperture: 0.11 };
    let mut rivals = 0.0_f64;
    stage.move_to(open, 800, |stage| rivals = rivals.max(stage.rival(Act::Rest)));
    assert!(stage.act(Act::Gesture(0)) > 0.8, "{:.2} when shown", stage.act(Act::Gesture(0)));
    assert!(rivals < 0.4, "evidence of {rivals:.2} for a grasp");
}

#[test]
fn passing_through_closing_and_holding_a_part_out_are_no_gesture() {
    let mut stage = Stage::new();
    let [x, y, z] = stage.task.scene.handover;
    let closed = Hand { centre: [x - 0.08, y, z], pitch: 0.0, aperture: 0.03 };
    stage.move_to(closed, 800, |stage| assert!(stage.act(Act::Gesture(0)) < 0.4, "a closed hand"));

    let mut stage = Stage::new();
    let wheel = stage.part("wheel");
    let holding = Hand { centre: [x, y, z + 0.0125], pitch: -0.17, aperture: 0.09 };
    let start = stage.hand;
    stage.run(1500, |stage, time| {
        stage.hand = start.towards(&holding, support::smooth(time as f64 / 900.0));
        let [x, y, z] = stage.hand.centre;
        stage.things[wheel].position = [x, y, z - 0.0125];
        assert!(stage.act(Act::Gesture(0)) < 0.4, "a part is held out");
    });

    let mut stage = Stage::new();
    stage.hand = Hand { centre: [-0.60, 0.50, 1.0], pitch: 0.0, aperture: 0.10 };
    stage.run(800, |_, _| {});
    let beyond = Hand { centre: [-0.64, -0.35, 1.04], ..stage.hand };
    stage.move_to(beyond, 500, |stage| assert!(stage.act(Act::Gesture(0)) < 0.4, "passing through"));
}

/// A hand there, whose index finger is stretched out towards a place, and whose middle finger is folded.
fn pointing(stage: &mut Stage, centre: [f64; 3], at: [f64; 3]) {
    stage.hand = Hand { centre, pitch: 0.0, aperture: 0.05 };
    let knuckle: [f64; 3] = [centre[0] - 0.06, centre[1] + 0.025, centre[2]];
    let way: [f64; 3] = std::array::from_fn(|axis| at[axis] - knuckle[axis]);
    let length = way.iter().map(|value| value * value).sum::<f64>().sqrt();
    let tip = std::array::from_fn(|axis| knuckle[axis] + 0.095 * way[axis] / length);
    let folded = [centre[0] - 0.09, centre[1], centre[2] - 0.02];
    let seen = |position| Keypoint { position, confidence: 0.9 };
    stage.wrong = vec![(KeypointName::IndexTip, seen(tip)), (KeypointName::MiddleTip, seen(folded))];
}

#[test]
fn a_finger_that_points_is_evidence_for_the_part_that_it_points_at() {
    for name in ["nut", "column 3", "top floor"] {
        let mut stage = Stage::new();
        let [x, y, z] = stage.things[stage.part(name)].position;
        pointing(&mut stage, [-0.75, 0.45, 1.1], [x, y, z + 0.02]);
        stage.run(500, |_, _| {});
        let kind = stage.kind(name);
        let points = |stage: &Stage, chosen: bool| {
            let acts = stage.task.acts.iter().enumerate().filter_map(|(index, act)| match act {
                Act::Point(chain) => Some((stage.task.chains[*chain].kind, stage.percept.act[index])),
                _ => None,
            });
            acts.filter(|(own, _)| (*own == kind) == chosen).map(|(_, evidence)| evidence).fold(0.0, f64::max)
        };
        assert!(points(&stage, true) > 0.7, "{name}: {:.2}", points(&stage, true));
        assert!(points(&stage, false) < 0.3, "{name}: {:.2} for another one", points(&stage, false));
        assert!(stage.act(Act::Gesture(0)) < 0.3 && stage.rival(Act::Rest) < 0.3);
    }
}

#[test]
fn a_hand_that_passes_and_a_finger_that_points_at_nothing_are_no_pointing() {
    let none = |stage: &Stage| {
        let acts = stage.task.acts.iter().zip(&stage.percept.act);
        acts.filter(|(act, _)| matches!(act, Act::Point(_))).all(|(_, evidence)| *evidence < 0.2)
    };
    let mut stage = Stage::new();
    pointing(&mut stage, [-0.75, 0.45, 1.1], [-0.75, 1.5, 1.1]);
    stage.run(500, |_, _| {});
    assert!(none(&stage), "the finger points at nothing");

    let mut stage = Stage::new();
    let [x, y, z] = stage.things[stage.part("nut")].position;
    stage.run(500, |stage, time| {
        pointing(stage, [-0.75, 0.1 + 0.8e-3 * time as f64, 1.1], [x, y, z]);
        // The hand was put there: its velocity is known after some frames.
        assert!(time < 200 || none(stage), "the hand goes past, {time} ms");
    });
}
