//! Which grips a hand has for what it shall take.
#![allow(clippy::unwrap_used)]

use coact_robot::{Graspable, Grip, GripKind, GripSide, Grips, Hand, NextUse, Robot};
use nalgebra::{Isometry3, Point3};
use std::path::Path;
use std::sync::LazyLock;

static HAND: LazyLock<Hand> = LazyLock::new(|| {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    Robot::load(&root.join("../../rt-config/robots/aros.toml")).unwrap().hand
});

const ABOVE: (GripKind, GripSide) = (GripKind::Precision, GripSide::Above);
const PINCHED: (GripKind, GripSide) = (GripKind::Precision, GripSide::Beside);
const ENCLOSED: (GripKind, GripSide) = (GripKind::WholeHand, GripSide::Beside);

fn column() -> Graspable {
    Graspable::round(0.055, 0.12)
}

fn kinds(object: Graspable, next: NextUse) -> Vec<(GripKind, GripSide)> {
    Grips::of(&HAND, object, next).all.iter().map(|grip| (grip.kind, grip.side)).collect()
}

fn grip(object: Graspable, wanted: (GripKind, GripSide)) -> Grip {
    let grips = Grips::of(&HAND, object, NextUse::Anything);
    *grips.all.iter().find(|grip| (grip.kind, grip.side) == wanted).unwrap()
}

#[test]
fn the_palm_is_known_from_its_form() {
    assert!((HAND.palm_face - 0.05).abs() < 1e-9 && (HAND.half_breadth - 0.045).abs() < 1e-9);
}

#[test]
fn a_tall_column_can_be_taken_in_all_ways_and_a_low_part_only_from_above() {
    assert_eq!(kinds(column(), NextUse::Anything), [ABOVE, PINCHED, ENCLOSED]);
    for (width, height) in [(0.025, 0.02), (0.075, 0.025), (0.055, 0.03), (0.03, 0.05)] {
        assert_eq!(kinds(Graspable::round(width, height), NextUse::Anything), [ABOVE]);
    }
    assert_eq!(kinds(Graspable::brick([0.1, 0.018, 0.012], 0.018), NextUse::Anything), [ABOVE]);
}

#[test]
fn the_whole_hand_takes_only_what_it_can_reach_around() {
    for width in [0.04, 0.055, 0.07] {
        assert!(kinds(Graspable::round(width, 0.15), NextUse::Anything).contains(&ENCLOSED), "{width}");
    }
    assert!(!kinds(Graspable::round(0.13, 0.15), NextUse::Anything).contains(&ENCLOSED));
    assert!(!kinds(Graspable::brick([0.05, 0.2, 0.15], 0.05), NextUse::Anything).contains(&ENCLOSED));
    let mut short = HAND.clone();
    for finger in &mut short.fingers {
        finger.end.translation.vector *= 0.3;
        finger.joints.last_mut().unwrap().origin.translation.vector *= 0.4;
    }
    assert!(
        Grips::of(&short, column(), NextUse::Anything)
            .all
            .iter()
            .all(|grip| grip.kind == GripKind::Precision)
    );
}

#[test]
fn what_is_enclosed_lies_deeper_in_the_hand_between_palm_and_fingers() {
    let (pinched, enclosed) = (grip(column(), PINCHED), grip(column(), ENCLOSED));
    assert!(enclosed.depth < pinched.depth - 0.03, "{} against {}", enclosed.depth, pinched.depth);
    assert!(enclosed.depth - 0.0275 > HAND.palm_face);
    let [one, two, three] = HAND.ends(&enclosed.fingers(&HAND, &column(), 0.0));
    for end in [one, two, three] {
        assert!(end.z > enclosed.depth + 0.0275, "the fingers end behind it: {end}");
    }
    assert!(HAND.interlaces && one.x < three.x, "finger 3 passes between the others: {one}, {three}");
    let meeting = Hand { interlaces: false, ..HAND.clone() };
    let grips = Grips::of(&meeting, column(), NextUse::Anything);
    let enclosed = grips.all.iter().find(|grip| grip.kind == GripKind::WholeHand);
    for end in enclosed.iter().flat_map(|grip| meeting.ends(&grip.fingers(&meeting, &column(), 0.0))) {
        assert!(end.x.abs() > HAND.pad[1] - 1e-9, "fingers that do not pass each other do not meet: {end}");
    }
}

#[test]
fn fingers_that_press_close_further_and_open_ones_are_clear() {
    let grips = Grips::of(&HAND, column(), NextUse::Anything);
    for grip in &grips.all {
        let [open, touching, pressing] =
            [0.01, 0.0, -0.005].map(|gap| grip.fingers(&HAND, &column(), gap)[3]);
        assert!(open < touching && touching <= pressing, "{grip:?}: {open} {touching} {pressing}");
        assert!(grips.open[3] <= open + 1e-9);
    }
}

#[test]
fn what_follows_decides_how_it_is_taken() {
    // Deep into a hole: what would reach into it with the hand is out.
    assert_eq!(kinds(column(), NextUse::Insert { depth: 0.02 }), [ABOVE, PINCHED]);
    assert_eq!(kinds(column(), NextUse::Insert { depth: 0.05 }), [ABOVE]);
    // A person needs a place for the fingers.
    assert_eq!(kinds(column(), NextUse::HandOver { room: 0.05 }), [ABOVE]);
    assert_eq!(
        kinds(Graspable::round(0.055, 0.25), NextUse::HandOver { room: 0.05 }),
        [ABOVE, PINCHED, ENCLOSED]
    );
    // A nut has no such place, but must be taken all the same.
    assert_eq!(kinds(Graspable::round(0.025, 0.02), NextUse::HandOver { room: 0.05 }), [ABOVE]);
}

#[test]
fn goals_bring_the_part_to_its_place_in_the_hand() {
    let frame = Isometry3::translation(-0.4, 0.5, 0.8);
    let grips = Grips::of(&HAND, column(), NextUse::Anything);
    let goals = grips.goals(&frame, 0.15, 0.8);
    assert_eq!(goals.len(), 1 + 12 + 12);
    for (index, goal) in goals {
        let palm = HAND.palm_at(&goal.point, &goal.approach, &goal.closing_axis, 0.0);
        let grip = &grips.all[index];
        let held = palm * Point3::new(0.0, 0.0, grip.depth);
        assert!((held - frame * Point3::new(0.0, 0.0, grip.height)).norm() < 1e-9);
        assert!((goal.approach.z + 1.0).abs() < 1e-9 || goal.approach.z.abs() < 1e-9);
        assert!(goal.closing_axis.z.abs() < 1e-9);
    }
}

#[test]
fn a_box_is_taken_across_the_side_that_is_named() {
    let frame = Isometry3::translation(-0.4, 0.5, 0.8);
    let grips = Grips::of(&HAND, Graspable::brick([0.06, 0.04, 0.15], 0.04), NextUse::Anything);
    assert!(grips.all.iter().any(|grip| grip.side == GripSide::Beside));
    for (_, goal) in grips.goals(&frame, 0.15, 0.8) {
        assert!((goal.closing_axis.y.abs() - 1.0).abs() < 1e-9, "{}", goal.closing_axis);
        assert_eq!(goal.rolls, 2);
    }
}
