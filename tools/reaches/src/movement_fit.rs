use crate::level_fit::rounded;
use coact_messages::KeypointName;
use coact_perception::{CURVE_BEGINS, CURVE_KNOTS, CURVE_MODES, CURVE_SPACING, MovementModel, TENTH};
use coact_recordings::{Frame, Reach};
use nalgebra::{DMatrix, DVector, SymmetricEigen, Vector2};
use std::collections::BTreeSet;

/// When the hand lies still before a reach, s since the labelled onset: the recordings begin half a second before it.
const REST: (f64, f64) = (-0.46, -0.30);
/// Frames of which the median is taken: single ones of the detector are mistaken.
const STEADY: usize = 5;
/// Shortest time from a tenth of the way to contact that a reach may have taken, s: what is shorter has a label that is wrong.
const SHORTEST: f64 = 0.2;
/// Fraction of the reaches, those most unlike the mean, that are left out: in these the detector jumps.
const UNLIKE: f64 = 0.05;
/// Fewest reaches that tell in what ways they differ: twice as many as there are modes.
const FEWEST: usize = 2 * CURVE_MODES;
/// Largest share that may lie between people: nobody's reaches are all alike.
const MOST_BETWEEN: f64 = 0.95;
/// Coordinates of a curve: those along come first, those aside after them.
const LENGTH: usize = 2 * CURVE_KNOTS;

/// The way of the hand in one reach, as perception describes it.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    participant: u32,
    /// From a tenth of the way to contact, s.
    duration: f64,
    way: DVector<f64>,
}

/// How the hands moved on these ways; `None` where there are too few.
pub(crate) fn movement<'a>(curves: impl Iterator<Item = &'a Curve>) -> Option<MovementModel> {
    let mut likely: Vec<&Curve> = curves.collect();
    let usual = mean(likely.iter().map(|curve| &curve.way))?;
    likely.sort_by(|one, other| (&one.way - &usual).norm().total_cmp(&(&other.way - &usual).norm()));
    likely.truncate(((1.0 - UNLIKE) * likely.len() as f64) as usize);
    let mean = mean(likely.iter().map(|curve| &curve.way))?;
    if likely.len() < FEWEST {
        return None;
    }
    let count = likely.len() as f64;
    let mut covariance = DMatrix::zeros(LENGTH, LENGTH);
    for curve in &likely {
        let miss = &curve.way - &mean;
        covariance.ger(1.0 / count, &miss, &miss, 1.0);
    }
    let (modes, left) = modes(covariance);
    let along = |mode: &DVector<f64>, curve: &Curve| {
        mode.dot(&(&curve.way - &mean)) / mode.norm_squared().max(f64::MIN_POSITIVE)
    };
    let own = |mode| rounded(between_people(&likely, |curve| along(mode, curve)));
    let log = likely.iter().map(|curve| curve.duration.ln()).sum::<f64>() / count;
    let spread = (likely.iter().map(|curve| (curve.duration.ln() - log).powi(2)).sum::<f64>() / count).sqrt();
    Some(MovementModel {
        duration: rounded(log.exp()),
        spread: rounded(spread),
        scatter: rounded(left / LENGTH as f64),
        mean: places(&mean),
        own: modes.iter().map(own).collect(),
        own_pace: rounded(between_people(&likely, |curve| curve.duration.ln())),
        modes: modes.iter().map(places).collect(),
    })
}

/// Share of the variance of `value` that lies between people: that of their means.
fn between_people(curves: &[&Curve], value: impl Fn(&Curve) -> f64) -> f64 {
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len().max(1) as f64;
    let variance =
        |of: &[f64]| of.iter().map(|own| (own - mean(of)).powi(2)).sum::<f64>() / of.len().max(1) as f64;
    let people: BTreeSet<u32> = curves.iter().map(|curve| curve.participant).collect();
    let of = |person: u32| -> Vec<f64> {
        curves.iter().filter(|curve| curve.participant == person).map(|curve| value(curve)).collect()
    };
    let means: Vec<f64> = people.iter().map(|person| mean(&of(*person))).collect();
    let all: Vec<f64> = curves.iter().map(|curve| value(curve)).collect();
    (variance(&means) / variance(&all).max(f64::MIN_POSITIVE)).clamp(0.0, MOST_BETWEEN)
}

fn mean<'a>(curves: impl Iterator<Item = &'a DVector<f64>> + Clone) -> Option<DVector<f64>> {
    let count = curves.clone().count();
    (count > 0).then(|| curves.fold(DVector::zeros(LENGTH), |sum, own| sum + own) / count as f64)
}

/// The directions of the largest variance, each as long as its standard deviation, and the variance that is left.
fn modes(covariance: DMatrix<f64>) -> (Vec<DVector<f64>>, f64) {
    let eigen = SymmetricEigen::new(covariance);
    let mut order: Vec<usize> = (0..LENGTH).collect();
    order.sort_by(|one, other| eigen.eigenvalues[*other].total_cmp(&eigen.eigenvalues[*one]));
    let mode = |index: &usize| {
        let own = eigen.eigenvectors.column(*index) * eigen.eigenvalues[*index].max(0.0).sqrt();
        // Which way an eigenvector points is chance; the file is to be the same each time.
        if own[own.iamax()] < 0.0 { -own } else { own }
    };
    let left = order[CURVE_MODES..].iter().map(|index| eigen.eigenvalues[*index].max(0.0)).sum();
    (order[..CURVE_MODES].iter().map(mode).collect(), left)
}

fn places(way: &DVector<f64>) -> Vec<[f64; 2]> {
    (0..CURVE_KNOTS).map(|knot| [rounded(way[knot]), rounded(way[CURVE_KNOTS + knot])]).collect()
}

/// The way of one reach; `None` where the hand cannot be followed from rest to contact.
pub(crate) fn curve(reach: &Reach) -> Option<Curve> {
    let way = steady(reach);
    let resting = way.iter().filter(|(time, _)| (REST.0..REST.1).contains(time));
    let resting: Vec<Vector2<f64>> = resting.map(|(_, place)| *place).collect();
    let start = resting.iter().sum::<Vector2<f64>>() / resting.len() as f64;
    let whole = at(&way, reach.movement_time)? - start;
    let side = thumb_side(reach)?;
    if resting.is_empty() || whole.norm() == 0.0 {
        return None;
    }
    let covered = |place: &Vector2<f64>| (place - start).norm() / whole.norm();
    let passes = |pair: &&[(f64, Vector2<f64>)]| {
        pair[1].0 > REST.1 && covered(&pair[0].1) < TENTH && covered(&pair[1].1) >= TENTH
    };
    let pair = way.windows(2).find(passes)?;
    let [before, after] = [covered(&pair[0].1), covered(&pair[1].1)];
    let begun = pair[0].0 + (TENTH - before) / (after - before) * (pair[1].0 - pair[0].0);
    let duration = reach.movement_time - begun;
    let mut own = DVector::zeros(LENGTH);
    for knot in 0..CURVE_KNOTS {
        let moved = at(&way, begun + duration * (CURVE_BEGINS + CURVE_SPACING * knot as f64))? - start;
        own[knot] = moved.dot(&whole) / whole.norm_squared();
        own[CURVE_KNOTS + knot] = side * whole.perp(&moved) / whole.norm_squared();
    }
    (duration > SHORTEST).then_some(Curve { participant: reach.participant, duration, way: own })
}

/// The middle between thumb and index tip wherever both are found, pixels, with single mistakes taken out.
fn steady(reach: &Reach) -> Vec<(f64, Vector2<f64>)> {
    let seen: Vec<(f64, Vector2<f64>)> = reach
        .frames
        .iter()
        .filter_map(|frame| {
            let middle =
                (point(frame, KeypointName::ThumbTip)? + point(frame, KeypointName::IndexTip)?) * 0.5;
            Some((frame.time, middle))
        })
        .collect();
    let median = |index: usize, axis: usize| {
        let first = index.saturating_sub(STEADY / 2);
        let mut near: Vec<f64> =
            seen[first..(first + STEADY).min(seen.len())].iter().map(|(_, place)| place[axis]).collect();
        near.sort_by(f64::total_cmp);
        near[near.len() / 2]
    };
    (0..seen.len()).map(|index| (seen[index].0, Vector2::new(median(index, 0), median(index, 1)))).collect()
}

fn point(frame: &Frame, name: KeypointName) -> Option<Vector2<f64>> {
    let joint = frame.joints[name as usize];
    (joint.confidence > 0.0).then(|| Vector2::new(joint.x, joint.y))
}

/// Where the hand was, between frames; `None` before the first and after the last.
fn at(way: &[(f64, Vector2<f64>)], time: f64) -> Option<Vector2<f64>> {
    let next = way.partition_point(|(own, _)| *own < time);
    let (after, before) = (way.get(next)?, way.get(next.checked_sub(1)?)?);
    Some(before.1.lerp(&after.1, (time - before.0) / (after.0 - before.0)))
}

/// On which side of the hand the thumb was while it lay still, as perception finds it out.
fn thumb_side(reach: &Reach) -> Option<f64> {
    let sides = reach.frames.iter().filter(|frame| frame.time < REST.1).filter_map(|frame| {
        let wrist = point(frame, KeypointName::Wrist)?;
        let [ahead, thumb] =
            [KeypointName::LittleKnuckle, KeypointName::ThumbTip].map(|name| point(frame, name));
        Some((ahead? - wrist).perp(&(thumb? - wrist)).signum())
    });
    let sum: f64 = sides.sum();
    (sum != 0.0).then(|| sum.signum())
}
