//! Parts, places and hands: seen, gone, or out of view.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::{self, Hand, Stage, Thing, smooth, stands_before};
use coact_joint_task::Subgoal;
use coact_messages::{JOINTS, PERSON, ROBOT};
use coact_robot::Robot;

#[test]
fn parts_are_seen_where_they_lie() {
    let stage = Stage::new();
    let (wheel, nut) = (stage.kind("wheel"), stage.kind("nut"));
    let [robot, person] = [&stage.percept.workspace[ROBOT], &stage.percept.workspace[PERSON]];
    assert!(person.seen[wheel] > 0.9 && person.gone[wheel] < 0.1);
    assert!(robot.seen[nut] > 0.9 && person.seen[nut] < 0.1 && person.gone[nut] > 0.9);
    let rest = stage.task.scene.person_rest;
    let away = |at: [f64; 2]| (at[0] - rest[0]).hypot(at[1] - rest[1]);
    let wheels = stage.task.parts.iter().filter(|part| part.kind == wheel).map(|part| part.at);
    let nearest = wheels.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap();
    let found = person.position[wheel];
    assert!((found[0] - nearest[0]).hypot(found[1] - nearest[1]) < 1e-3, "{found:?} instead of {nearest:?}");
}

#[test]
fn missed_sightings_do_not_matter_and_a_part_that_is_taken_away_is_gone() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("column 1"), stage.kind("column 1"));
    stage.run(1500, |stage, time| {
        stage.things[part].visible = time / 33 % 4 != 0;
        assert!(stage.percept.workspace[PERSON].seen[kind] > 0.9);
    });
    stage.run(800, |stage, _| stage.things[part].visible = false);
    let place = &stage.percept.workspace[PERSON];
    assert!(place.seen[kind] < 0.1 && place.gone[kind] > 0.9);
}

/// Shows the person's column 1 as another kind of part in those ms that `mistaken` says; what is said of the two kinds afterwards.
fn taken_for_a_nut(mistaken: impl Fn(u64) -> bool) -> [f64; 2] {
    let mut stage = Stage::new();
    let (part, kind, other) = (stage.part("column 1"), stage.kind("column 1"), stage.kind("nut"));
    stage.run(3000, |stage, time| {
        stage.things[part].kind = if mistaken(time) { other } else { kind };
    });
    let person = &stage.percept.workspace[PERSON];
    [kind, other].map(|kind| person.seen[kind])
}

#[test]
fn a_part_that_is_taken_for_another_now_and_then_stays_what_it_is() {
    for mistaken in
        [|time: u64| time % 1000 < 200, |time: u64| (time / 33).is_multiple_of(3), |time: u64| time > 2200]
    {
        let [own, other] = taken_for_a_nut(mistaken);
        assert!(own > 0.9 && other < 0.1, "{own} {other}");
    }
}

#[test]
fn a_carried_part_that_is_taken_for_another_for_some_frames_stays_what_it_is() {
    // The way leads past column 2, and the top floor lies elsewhere.
    ["column 2", "top floor"].into_iter().for_each(carry_the_nut_that_is_taken_for);
}

fn carry_the_nut_that_is_taken_for(other: &str) {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("nut"), stage.kind("nut"));
    let other = stage.kind(other);
    let start = stage.hand;
    let [x, y, z] = start.centre;
    let there = support::Hand { centre: [x + 0.2, y + 0.3, z + 0.1], pitch: -1.3, aperture: 0.03 };
    stage.things[part].position = [x, y, z - 0.01];
    stage.run(800, |_, _| {});
    // 0.6 m/s at most: 2 cm from frame to frame.
    stage.run(900, |stage, time| {
        stage.hand = start.towards(&there, support::smooth(time as f64 / 900.0));
        let [x, y, z] = stage.hand.centre;
        stage.things[part].position = [x, y, z - 0.01];
        stage.things[part].kind = if (400..700).contains(&time) { other } else { kind };
        if time > 300 {
            let [own, mistaken] = [kind, other].map(|kind| stage.percept.person_holds[kind]);
            assert!(own > 0.9 && mistaken < 0.1, "after {time} ms: {own} {mistaken}");
        }
    });
}

#[test]
fn a_carried_part_that_is_out_of_sight_for_a_moment_is_still_in_the_hand() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("nut"), stage.kind("nut"));
    let start = stage.hand;
    let [x, y, z] = start.centre;
    let there = support::Hand { centre: [x + 0.3, y + 0.3, z + 0.1], pitch: -1.3, aperture: 0.03 };
    stage.things[part].position = [x, y, z - 0.01];
    stage.run(800, |_, _| {});
    // The hand has gone on by 0.2 m when the part is seen again.
    stage.run(900, |stage, time| {
        stage.hand = start.towards(&there, support::smooth(time as f64 / 900.0));
        let [x, y, z] = stage.hand.centre;
        stage.things[part].position = [x, y, z - 0.01];
        stage.things[part].visible = !(300..600).contains(&time);
        let held = stage.percept.person_holds[kind];
        assert!(time < 300 || held > 0.9, "after {time} ms: {held}");
    });
}

#[test]
fn a_part_that_is_always_taken_for_another_is_one() {
    let [own, other] = taken_for_a_nut(|time| time > 1000);
    assert!(own < 0.1 && other > 0.9, "{own} {other}");
}

/// What looks like a part of this kind stands 7 cm beside column 1: tells which thing it is.
fn with_what_looks_like(kind: usize, stage: &mut Stage) -> usize {
    let beside = stage.things[stage.part("column 1")];
    let [x, y, z] = beside.position;
    stage.things.push(Thing { kind, position: [x, y + 0.07, z], ..beside });
    stage.things.len() - 1
}

#[test]
fn what_single_frames_show_is_not_there() {
    let mut stage = Stage::new();
    let nut = stage.kind("nut");
    let index = with_what_looks_like(nut, &mut stage);
    // One of the two has been taken away: what is seen may be that one.
    let own = stage.part("nut");
    stage.things[own].visible = false;
    stage.run(3000, |stage, time| {
        stage.things[index].visible = time / 33 % 4 < 2;
        assert!(stage.percept.workspace[PERSON].seen[nut] < 0.1, "after {time} ms");
    });
    stage.run(300, |stage, _| stage.things[index].visible = true);
    assert!(stage.percept.workspace[PERSON].seen[nut] > 0.9, "what stays is there");
}

#[test]
fn what_looks_like_a_part_is_none_while_each_of_its_kind_is_seen_elsewhere() {
    let mut stage = Stage::new();
    let top = stage.kind("top floor");
    with_what_looks_like(top, &mut stage);
    stage.run(1000, |_, _| {});
    assert!(stage.percept.workspace[PERSON].seen[top] < 0.1);
    let own = stage.part("top floor");
    stage.run(1000, |stage, _| stage.things[own].visible = false);
    assert!(stage.percept.workspace[PERSON].seen[top] > 0.9, "it has been brought there");
}

#[test]
fn a_part_that_the_hand_hides_all_the_way_is_still_in_it() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("column 1"), stage.kind("column 1"));
    let over = stage.grasping(part, 0);
    stage.move_to(over.open(), 600, |_| {});
    stage.things[part].visible = false;
    stage.move_to(over, 200, |_| {});
    stage.run(150, |_, _| {});
    assert!(stage.percept.person_holds[kind] > 0.9, "taken");
    let [x, y, z] = over.centre;
    stage.move_to(Hand { centre: [x + 0.35, y - 0.1, z + 0.08], ..over }, 900, |stage| {
        assert!(stage.percept.person_holds[kind] > 0.9);
    });
}

#[test]
fn what_is_out_of_view_is_neither_seen_nor_gone() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("column 1"), stage.kind("column 1"));
    let at = stage.things[part].position;
    stands_before(&stage.task, &mut stage.sample.scene.surface, at, 0.3);
    stage.run(2000, |stage, _| stage.things[part].visible = false);
    let place = &stage.percept.workspace[PERSON];
    assert!(place.seen[kind] < 0.1 && place.gone[kind] < 0.1);
    assert!((place.position[kind][0] - at[0]).abs() < 1e-2, "the last known place is kept");
    stage.run(400, |stage, _| stage.things[part].visible = true);
    assert!(stage.percept.workspace[PERSON].seen[kind] > 0.9);
}

#[test]
fn what_is_covered_is_forgotten_once_all_of_its_kind_are_seen_elsewhere() {
    // Seen there and elsewhere at once, or elsewhere only after it was covered.
    for at_once in [true, false] {
        let mut stage = Stage::new();
        let (part, kind) = (stage.part("column 1"), stage.kind("column 1"));
        let at = stage.things[part].position;
        let there = stage.things.len();
        stage.things.push(stage.things[part]);
        stage.things[there].position = [-0.43, 0.60, at[2]];
        stage.things[there].visible = at_once;
        stage.run(500, |_, _| {});
        stands_before(&stage.task, &mut stage.sample.scene.surface, at, 0.3);
        stage.run(200, |stage, _| stage.things[part].visible = false);
        assert!(stage.percept.workspace[PERSON].gone[kind] < 0.1, "it may be there");
        stage.run(800, |stage, _| stage.things[there].visible = true);
        let [robot, person] = &stage.percept.workspace;
        let evidence = [robot.seen[kind], robot.gone[kind], person.seen[kind], person.gone[kind]];
        assert_eq!(evidence.map(|own| own > 0.9), [true, false, false, true], "{at_once}: {evidence:?}");
        assert!(evidence.iter().all(|own| !(0.1..0.9).contains(own)), "{evidence:?}");
    }
}

#[test]
fn a_part_that_is_mounted_on_its_side_is_hidden_where_its_upper_face_is() {
    // Hidden there, and in sight where the face of an upright one would be; then the other way round.
    for (hidden_at_its_face, stays) in [(true, true), (false, false)] {
        let mut stage = Stage::new();
        let (part, kind) = (stage.part("wheel"), stage.kind("wheel"));
        let goal = stage.task.subgoals.iter().rposition(|goal| goal.kind == kind).unwrap();
        let Subgoal { socket, axis, .. } = stage.task.subgoals[goal];
        assert_eq!(axis, [1.0, 0.0, 0.0], "across the lines of sight");
        let height = stage.task.kinds[kind].shape.height();
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        stage.things[part].position = socket;
        stage.things[part].orientation = [0.0, quarter, 0.0, quarter];
        stage.run(700, |_, _| {});
        assert!(stage.percept.achieved[goal] > 0.9);
        let (eye, surface) = (stage.task.scene.eye(), &mut stage.sample.scene.surface);
        // The sites around the direction of each face: of its own, and of the one that it would have if it stood upright.
        let [face, upright] = [axis, [0.0, 0.0, 1.0]].map(|up| {
            let shadow = surface.shadow(eye, [0, 1, 2].map(|i| socket[i] + height * up[i])).unwrap();
            let [along, across] = surface.grid.spacing.map(|spacing| 0.5 * spacing);
            let corners = [[-along, -across], [-along, across], [along, -across], [along, across]];
            corners.map(|[x, y]| surface.grid.site([shadow[0] + x, shadow[1] + y]).unwrap())
        });
        let (hidden, seen) = if hidden_at_its_face { (face, upright) } else { (upright, face) };
        hidden.into_iter().for_each(|site| surface.height[site] = 30);
        seen.into_iter().for_each(|site| surface.height[site] = 0);
        stage.run(1500, |stage, _| stage.things[part].visible = false);
        assert_eq!(stage.percept.achieved[goal] > 0.9, stays);
        assert_eq!(stage.percept.open[goal] > 0.9, !stays);
    }
}

#[test]
fn a_part_that_is_not_seen_where_the_table_is_seen_is_gone() {
    // Nothing is there; something no higher than the part; something high beside it; something high before it.
    for (height, aside, is_gone) in [(0.0, 0.0, true), (0.05, 0.0, true), (0.3, 0.2, true), (0.3, 0.0, false)]
    {
        let mut stage = Stage::new();
        let (part, kind) = (stage.part("column 1"), stage.kind("column 1"));
        let [x, y, z] = stage.things[part].position;
        stands_before(&stage.task, &mut stage.sample.scene.surface, [x, y + aside, z], height);
        stage.run(1500, |stage, _| stage.things[part].visible = false);
        let gone = stage.percept.workspace[PERSON].gone[kind];
        assert_eq!(gone > 0.9, is_gone, "{height} m high, {aside} m beside it: {gone}");
    }
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("column 1"), stage.kind("column 1"));
    stage.sample.scene.surface.grid.sites = [0, 0];
    stage.run(1500, |stage, _| stage.things[part].visible = false);
    assert!(stage.percept.workspace[PERSON].gone[kind] < 0.1, "without a picture it may be there");
}

#[test]
fn a_subgoal_is_open_until_its_part_lies_in_the_socket() {
    let mut stage = Stage::new();
    let goal = stage.task.subgoals.iter().position(|goal| goal.name == "column 1 in its hole").unwrap();
    let part = stage.part("column 1");
    assert!(stage.percept.open[goal] > 0.9 && stage.percept.achieved[goal] < 0.1);
    let socket = stage.task.subgoals[goal].socket;
    stage.run(700, |stage, _| stage.things[part].position = [socket[0] + 0.01, socket[1], socket[2]]);
    assert!(stage.percept.achieved[goal] > 0.9 && stage.percept.open[goal] < 0.1);
    stage.run(1000, |stage, _| stage.things[part].visible = false);
    assert!(stage.percept.open[goal] > 0.9 && stage.percept.achieved[goal] < 0.1, "taken out again");
}

#[test]
fn a_part_that_is_taken_for_its_unseen_neighbour_has_not_moved_it() {
    let mut stage = Stage::new();
    let parts = ["column 1", "column 2"].map(|kind| stage.part(kind));
    let goals = ["column 1 in its hole", "column 2 in its hole"]
        .map(|name| stage.task.subgoals.iter().position(|goal| goal.name == name).unwrap());
    for (part, goal) in parts.into_iter().zip(goals) {
        stage.things[part].position = stage.task.subgoals[goal].socket;
    }
    // Less far apart than a part may go from frame to frame.
    stage.things[parts[1]].position[0] += 0.004;
    stage.run(700, |_, _| {});
    let kinds = parts.map(|part| stage.things[part].kind);
    stage.run(300, |stage, time| {
        let mistaken = (100..135).contains(&time);
        stage.things[parts[0]].visible = !mistaken;
        stage.things[parts[1]].kind = kinds[usize::from(!mistaken)];
        assert!(goals.iter().all(|goal| stage.percept.achieved[*goal] > 0.9), "{time}");
    });
}

#[test]
fn a_place_that_cannot_be_seen_is_empty_where_every_part_that_fits_is_seen_elsewhere() {
    let mut stage = Stage::new();
    let goal = stage.task.subgoals.iter().position(|goal| goal.name == "column 1 in its hole").unwrap();
    let (part, socket) = (stage.part("column 1"), stage.task.subgoals[goal].socket);
    stands_before(&stage.task, &mut stage.sample.scene.surface, socket, 0.3);
    stage.run(500, |_, _| {});
    assert!(stage.percept.open[goal] > 0.9, "it lies on the table");
    stage.run(1500, |stage, _| stage.things[part].visible = false);
    assert!(stage.percept.open[goal] < 0.1, "it may be anywhere");
}

#[test]
fn a_part_that_stands_beside_its_socket_is_not_in_it() {
    for (away, mounted) in [(0.012, true), (0.016, false), (0.025, false)] {
        let mut stage = Stage::new();
        let goal = stage.task.subgoals.iter().position(|goal| goal.name == "column 1 in its hole").unwrap();
        let (part, socket) = (stage.part("column 1"), stage.task.subgoals[goal].socket);
        stage.run(700, |stage, _| stage.things[part].position = [socket[0], socket[1] + away, socket[2]]);
        let achieved = stage.percept.achieved[goal];
        assert!(if mounted { achieved > 0.9 } else { achieved < 0.1 }, "{away} m: {achieved}");
    }
}

#[test]
fn a_mounted_part_is_free_in_no_workspace_and_stays_mounted_while_the_hand_is_near() {
    let mut stage = Stage::new();
    let goal = stage.task.subgoals.iter().position(|goal| goal.name == "wheel on the person's side").unwrap();
    let wheel = stage.part("wheel");
    stage.things[wheel].position = stage.task.subgoals[goal].socket;
    stage.run(800, |_, _| {});
    let nut = stage.kind("nut");
    let near = support::Hand { centre: stage.task.subgoals[goal].socket, pitch: -1.3, aperture: 0.03 };
    let nut_part = stage.part("nut");
    let start = stage.hand;
    stage.things[nut_part].position = start.centre;
    stage.run(1500, |stage, time| {
        stage.hand = start.towards(&near, support::smooth(time as f64 / 900.0));
        let [x, y, z] = stage.hand.centre;
        stage.things[nut_part].position = [x, y, z - 0.01];
    });
    assert!(stage.percept.person_holds[nut] > 0.9, "the nut is in the hand");
    assert!(stage.percept.achieved[goal] > 0.9, "the wheel beside it is not");
}

#[test]
fn a_touched_part_in_the_air_is_in_the_robots_hand() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("top floor"), stage.kind("top floor"));
    stage.run(500, |stage, _| stage.sample.joints.touch = 5.0);
    assert!(stage.percept.robot_holds[kind] < 0.1, "it lies on the table");
    stage.run(1000, |stage, time| {
        stage.things[part].position[2] += if time < 400 { 0.0005 } else { 0.0 };
        stage.sample.joints.touch = 5.0;
    });
    assert!(stage.percept.robot_holds[kind] > 0.9);
    assert!(stage.percept.workspace[ROBOT].seen[kind] < 0.1, "it is not free any more");
    stage.run(300, |stage, _| stage.sample.joints.touch = 0.0);
    assert!(stage.percept.robot_holds[kind] < 0.1);
}

/// The robot, parked but for what is added to its joints, rad, has the top floor in its fingers. Tells its joints, and where the part is held in
/// others.
fn holding_the_top_floor(
    stage: &mut Stage,
    added: [f64; JOINTS],
) -> ([f64; JOINTS], impl Fn(&[f64; JOINTS]) -> [f64; 3] + use<>) {
    let robot = Robot::load(&support::configuration("robots/aros.toml")).unwrap();
    stage.perception = support::perception(&stage.task).with_robot(robot.clone());
    let (part, kind) = (stage.part("top floor"), stage.kind("top floor"));
    let mut joints = added;
    (0..7).for_each(|joint| joints[joint] += robot.park[joint]);
    let middle = 0.5 * stage.task.kinds[kind].shape.height();
    let held_at = move |joints: &[f64; JOINTS]| {
        let point = robot.grasp_point(joints);
        [point.x, point.y, point.z - middle]
    };
    stage.run(1000, |stage, _| {
        (stage.sample.joints.position, stage.sample.joints.touch) = (joints, 5.0);
        stage.things[part].position = held_at(&joints);
    });
    assert!(stage.percept.robot_holds[kind] > 0.9);
    (joints, held_at)
}

#[test]
fn what_the_robot_holds_out_of_sight_goes_where_its_palm_goes() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("top floor"), stage.kind("top floor"));
    let (mut joints, held_at) = holding_the_top_floor(&mut stage, [0.0; JOINTS]);
    stage.sample.scene.surface.height.fill(200);
    stage.things[part].visible = false;
    stage.run(1000, |stage, _| {
        joints[0] += 0.0006;
        stage.sample.joints.position = joints;
        assert!(stage.percept.robot_holds[kind] > 0.9, "while it is carried unseen");
    });
    stage.things[part].position = held_at(&joints);
    stage.things[part].visible = true;
    stage.run(200, |stage, _| assert!(stage.percept.robot_holds[kind] > 0.9, "seen where it was carried to"));
}

/// The robot holds the top floor 0.2 m above the table, and opens its fingers; `then` moves things from there on, told for how long, ms. Tells
/// the evidence that the part is lost `after` so long.
fn lost_after_opening(after: u64, then: impl Fn(&mut Stage, usize, u64)) -> f64 {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("top floor"), stage.kind("top floor"));
    stage.run(1000, |stage, time| {
        stage.things[part].position[2] += if time < 400 { 0.0005 } else { 0.0 };
        stage.sample.joints.touch = 5.0;
        stage.sample.joints.position[8..11].fill(1.4);
    });
    assert!(stage.percept.robot_holds[kind] > 0.9);
    stage.run(after, |stage, time| {
        stage.sample.joints.touch = 0.0;
        stage.sample.joints.position[8..11].fill(1.0);
        then(stage, part, time);
    });
    stage.percept.lost[kind]
}

#[test]
fn a_part_that_falls_when_the_robot_lets_it_go_is_lost_and_one_that_is_taken_is_not() {
    let falls =
        |stage: &mut Stage, part: usize| stage.things[part].position[2] = stage.task.scene.table_height;
    assert!(lost_after_opening(800, |stage, part, _| falls(stage, part)) > 0.9);
    assert!(lost_after_opening(800, |_, _, _| {}) < 0.1, "somebody has it");
    let hide = |stage: &mut Stage, part: usize, hides: bool| stage.things[part].visible = !hides;
    assert!(lost_after_opening(800, |stage, part, _| hide(stage, part, true)) < 0.1, "a hand hides it");
    let found_later = lost_after_opening(4_000, |stage, part, time| {
        hide(stage, part, time < 3_000);
        falls(stage, part);
    });
    assert!(found_later > 0.9, "{found_later}: where it fell could not be seen");
}

#[test]
fn a_part_that_lies_below_the_closed_hand_is_lost_and_one_that_is_felt_again_is_not() {
    /// By how much the elbow is straighter than parked, rad: the fingers are 5 cm above the table then.
    const LOWERED: f64 = 0.3;
    let lost_when_felt_again_after = |cycles: u64| {
        let mut stage = Stage::new();
        let (part, kind) = (stage.part("top floor"), stage.kind("top floor"));
        let mut added = [0.0; JOINTS];
        added[3] = LOWERED;
        added[8..11].fill(1.4);
        _ = holding_the_top_floor(&mut stage, added);
        stage.run(1200, |stage, time| {
            stage.sample.joints.touch = if time < cycles { 0.0 } else { 5.0 };
            stage.things[part].position[2] = stage.task.scene.table_height;
        });
        stage.percept.lost[kind]
    };
    assert!(lost_when_felt_again_after(u64::MAX) > 0.9);
    assert!(lost_when_felt_again_after(150) < 0.1, "the fingers feel it again");
}

#[test]
fn a_resting_hand_that_comes_back_to_sight_over_a_part_has_not_taken_it() {
    let mut stage = Stage::new();
    let (part, kind) = (stage.part("nut"), stage.kind("nut"));
    let [x, y, z] = stage.hand.centre;
    stage.things[part].position = [x, y, z - 0.5 * stage.task.kinds[kind].shape.height()];
    stage.run(1000, |_, _| {});
    stage.tracking = false;
    stage.run(600, |_, _| {});
    stage.tracking = true;
    stage.run(1000, |_, _| {});
    assert_eq!(stage.percept.person_holds[kind], 0.0);
    // What goes with it, it has.
    let away = Hand { centre: [x + 0.2, y + 0.1, z + 0.1], ..stage.hand };
    let start = stage.hand;
    for time in 1..=600 {
        stage.hand = start.towards(&away, smooth(f64::from(time) / 600.0));
        let [x, y, z] = stage.hand.centre;
        stage.things[part].position = [x, y, z - 0.5 * stage.task.kinds[kind].shape.height()];
        stage.run(1, |_, _| {});
    }
    assert!(stage.percept.person_holds[kind] > 0.9, "{}", stage.percept.person_holds[kind]);
}
