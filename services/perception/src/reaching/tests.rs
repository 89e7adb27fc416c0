use super::*;
use crate::PreshapeModel;
use bytemuck::Zeroable;
use nalgebra::{Rotation2, Vector2};
use proptest::prelude::*;
use std::path::Path;

/// Frames of a camera of 60 Hz.
const FRAME: f64 = 1.0 / 60.0;

fn model() -> MovementModel {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/perception/preshape.toml");
    PreshapeModel::load(&file).unwrap().movement
}

/// The mean way to `way`, bent by so many standard deviations of its first mode, up to a time (1: contact).
fn reach(model: &MovementModel, way: Vector2<f64>, bent: f64, until: f64) -> HandPath {
    let at = |time: f64| {
        let position = ((time - CURVE_BEGINS) / CURVE_SPACING).clamp(0.0, (CURVE_KNOTS - 1) as f64);
        let knot = position.round() as usize;
        let [along, aside] = [0, 1].map(|axis| model.mean[knot][axis] + bent * model.modes[0][knot][axis]);
        way * along + Vector2::new(-way.y, way.x) * aside
    };
    let frames = ((until - CURVE_BEGINS) * model.duration / FRAME) as u32;
    let seen = (0..=frames).map(|frame| f64::from(frame) * FRAME);
    HandPath::of(Vector2::zeros(), seen.map(|time| (time, at(time / model.duration + CURVE_BEGINS))))
}

fn anyone() -> PersonMovement {
    PersonMovement::zeroed()
}

fn likelihood(reader: &MovementReader, path: &HandPath, person: &PersonMovement, place: Vector2<f64>) -> f64 {
    reader.likelihood(path, path.frames().len(), person, place)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn half_way_a_usual_reach_is_told_from_one_to_a_place_elsewhere(
        direction in 0.0..std::f64::consts::TAU,
        length in 0.25..0.5_f64,
        aside in prop::sample::select(vec![-1.0, 1.0]),
    ) {
        let model = model();
        let reader = MovementReader::new(&model);
        let way = Rotation2::new(direction) * Vector2::new(length, 0.0);
        let path = reach(&model, way, 0.0, 0.6);
        let there = likelihood(&reader, &path, &anyone(), way);
        let others = [Rotation2::new(aside * 0.5) * way, 2.0 * way, -way];
        for other in others {
            prop_assert!(there > likelihood(&reader, &path, &anyone(), other) + 5.0, "{way:?} against {other:?}");
        }
    }

    /// Where the table stands, and how it is turned, tells nothing.
    #[test]
    fn turning_path_and_places_changes_nothing(direction in 0.0..std::f64::consts::TAU, until in 0.0..1.0_f64) {
        let model = model();
        let reader = MovementReader::new(&model);
        let (way, other) = (Vector2::new(0.35, 0.0), Vector2::new(0.30, 0.12));
        let turn = Rotation2::new(direction);
        let (as_it_is, turned) = (reach(&model, way, 0.5, until), reach(&model, turn * way, 0.5, until));
        for place in [way, other] {
            let [one, two] = [
                likelihood(&reader, &as_it_is, &anyone(), place),
                likelihood(&reader, &turned, &anyone(), turn * place),
            ];
            prop_assert!((one - two).abs() < 0.05 * one.abs().max(1.0), "{one} {two}");
        }
    }
}

#[test]
fn no_reach_leads_to_where_the_hand_lay_or_before_it_has_moved() {
    let reader = MovementReader::new(&model());
    let path = reach(&model(), Vector2::new(0.3, 0.0), 0.0, 0.5);
    assert_eq!(likelihood(&reader, &path, &anyone(), Vector2::new(0.01, 0.0)), f64::NEG_INFINITY);
    assert_eq!(reader.likelihood(&path, 0, &anyone(), Vector2::new(0.3, 0.0)), f64::NEG_INFINITY);
}

#[test]
fn who_always_reaches_in_an_arc_is_understood_better_after_some_reaches() {
    let model = model();
    let reader = MovementReader::new(&model);
    let (way, bent) = (Vector2::new(0.35, 0.1), 1.8);
    let mut person = anyone();
    for _ in 0..8 {
        reader.learn(&reach(&model, way, bent, 1.0), way, &mut person);
    }
    let path = reach(&model, way, bent, 0.5);
    // The place that a straight reach through the same points would lead to.
    let elsewhere = Rotation2::new(-0.2) * way;
    let apart = |person: &PersonMovement| {
        (likelihood(&reader, &path, person, way) - likelihood(&reader, &path, person, elsewhere)).abs()
    };
    assert!(likelihood(&reader, &path, &person, way) > likelihood(&reader, &path, &anyone(), way) + 0.5);
    assert!(apart(&person) > apart(&anyone()));
}

#[test]
fn one_place_is_looked_at_in_a_cycle_and_all_are_told_of_together() {
    let model = model();
    let reader = MovementReader::new(&model);
    let path = reach(&model, Vector2::new(0.35, 0.0), 0.0, 0.6);
    let places = [Vector2::new(0.35, 0.0), Vector2::new(0.0, 0.35), Vector2::new(0.3, 0.15)];
    let mut likelihoods = Likelihoods::zeroed();
    likelihoods.begin();
    for cycle in 0..=places.len() {
        assert!((0..places.len()).all(|index| likelihoods.of(index) == likelihoods.of(0)), "after {cycle}");
        likelihoods.step(&reader, &path, &anyone(), |index| places.get(index).copied());
    }
    assert_eq!(likelihoods.of(0), 0.0);
    assert!(likelihoods.of(1) < -1.0 && likelihoods.of(1) > -3.0, "bounded: {}", likelihoods.of(1));
}
