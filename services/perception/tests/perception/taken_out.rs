//! Parts that are taken out of their sockets again.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::{self, Hand, Stage, resting};
use coact_joint_task::Act;

/// Puts a part into the first socket of its kind.
fn put_into_socket(stage: &mut Stage, part: usize) {
    let kind = stage.things[part].kind;
    stage.things[part].position = stage.task.subgoals.iter().find(|goal| goal.kind == kind).unwrap().socket;
}

/// Puts the first part of a kind into the first socket of its kind; its index.
fn mount(stage: &mut Stage, name: &str) -> usize {
    let part = stage.part(name);
    put_into_socket(stage, part);
    part
}

/// The hand goes to a part and closes on it.
fn take(stage: &mut Stage, part: usize) {
    let closed = stage.grasping(part, 0);
    stage.move_to(closed.open(), 700, |_| {});
    stage.move_to(closed, 100, |_| {});
    stage.run(200, |_, _| {});
}

/// Carries it there in so many ticks; before each, `change` is told how far along it is.
fn carry(
    stage: &mut Stage,
    part: usize,
    place: [f64; 3],
    ticks: u32,
    mut change: impl FnMut(&mut Stage, f64),
) {
    let (hand, from) = (stage.hand, stage.things[part].position);
    let shift: [f64; 3] = std::array::from_fn(|axis| place[axis] - from[axis]);
    for time in 1..=ticks {
        let along = support::smooth(f64::from(time) / f64::from(ticks));
        stage.hand.centre = std::array::from_fn(|axis| hand.centre[axis] + along * shift[axis]);
        stage.things[part].position = std::array::from_fn(|axis| from[axis] + along * shift[axis]);
        change(stage, along);
        stage.run(1, |_, _| {});
    }
}

/// Carries it there, and lets it go.
fn lay_down(stage: &mut Stage, part: usize, place: [f64; 3]) {
    carry(stage, part, place, 800, |_, _| {});
    let open = Hand { aperture: stage.hand.aperture + 0.07, ..stage.hand };
    stage.move_to(open, 150, |_| {});
    let rest = resting(&stage.task);
    stage.move_to(rest, 600, |_| {});
    stage.run(1000, |_, _| {});
}

#[test]
fn what_is_taken_out_of_its_socket_tells_no_grasp_until_it_has_been_laid_down() {
    let mut stage = Stage::new();
    let (part, kind) = (mount(&mut stage, "column 2"), stage.kind("column 2"));
    stage.run(700, |_, _| {});
    let act = stage.task.acts.iter().position(|act| *act == Act::Grasp { grip: 0, kind }).unwrap();
    take(&mut stage, part);
    assert!(stage.percept.person_holds[kind] > 0.9);
    assert!(stage.percept.act[act] < 0.1, "{}", stage.percept.act[act]);
    let on_the_table = [-1.0, 0.3, stage.task.scene.table_height];
    lay_down(&mut stage, part, on_the_table);
    assert!(stage.percept.person_holds[kind] < 0.1);
    take(&mut stage, part);
    assert!(stage.percept.person_holds[kind] > 0.9 && stage.percept.act[act] > 0.9);
}

#[test]
fn what_is_carried_out_of_sight_past_a_mounted_part_of_its_kind_is_not_taken_for_it() {
    let mut stage = Stage::new();
    let (carried, kind) = (stage.part("wheel"), stage.kind("wheel"));
    let mounted = stage.things.iter().rposition(|thing| thing.kind == kind).unwrap();
    put_into_socket(&mut stage, mounted);
    stage.run(700, |_, _| {});
    take(&mut stage, carried);
    let [x, y, z] = stage.things[mounted].position;
    carry(&mut stage, carried, [x - 0.03, y + 0.1, z + 0.03], 700, |_, _| {});
    carry(&mut stage, carried, [x - 0.03, y - 0.1, z + 0.03], 300, |stage, along| {
        stage.things[carried].visible = !(0.2..0.5).contains(&along);
        stage.things[mounted].visible = !(0.5..0.75).contains(&along);
    });
    stage.things[mounted].visible = true;
    stage.run(200, |_, _| {});
    let act = stage.task.acts.iter().position(|act| *act == Act::Grasp { grip: 0, kind }).unwrap();
    assert!(
        stage.percept.person_holds[kind] > 0.9 && stage.percept.act[act] > 0.9,
        "{:?}",
        stage.percept.act
    );
}

#[test]
fn of_parts_that_are_mounted_side_by_side_the_one_between_the_fingers_is_taken() {
    for (taken, left) in [("wheel", "nut"), ("nut", "wheel")] {
        let mut stage = Stage::new();
        mount(&mut stage, left);
        let part = mount(&mut stage, taken);
        stage.run(700, |_, _| {});
        take(&mut stage, part);
        let holds = |name: &str| stage.percept.person_holds[stage.kind(name)];
        assert!(holds(taken) > 0.9 && holds(left) < 0.1, "{taken}");
    }
}

#[test]
fn hand_that_goes_to_a_mounted_part_takes_nothing_that_lies_on_its_way() {
    let mut stage = Stage::new();
    let (part, column) = (mount(&mut stage, "wheel"), stage.kind("column 1"));
    stage.run(700, |_, _| {});
    let end = Hand { aperture: 0.1, ..stage.grasping(part, 0) };
    let mut most = 0.0_f64;
    stage.move_to(end, 700, |stage| {
        let on_the_way = stage.on_the_way(column);
        most = most.max(on_the_way);
    });
    assert!(most < 0.5, "{most}");
}
