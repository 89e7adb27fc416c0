//! Ways through several postures, for where no single excursion helps.

use crate::solver::anywhere;
use crate::work::Work;
use crate::{Clearance, Mechanism};
use coact_robot::Posture;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::cell::RefCell;

/// Length of a step in posture space, rad, and steps of the search.
const STEP: f64 = 0.15;
const TRIES: usize = 4_000;
/// Times that the way found is shortened across.
const ROUNDS: usize = 4;

/// Postures between `from` and `to`, such that the straight ways of the joints between them keep `margin` m from
/// everything: found by growing trees from both ends (RRT-Connect), then shortened. None when the search ends without
/// a way.
pub(crate) fn find(
    clearance: &Clearance,
    [from, to]: [&Posture; 2],
    margin: f64,
    work: &Work,
) -> Option<Vec<Posture>> {
    let is_free = |posture: &Posture| work.spend(1) && clearance.is_clear(posture, margin);
    let mut way = connect(clearance.mechanism, [from, to], is_free, STEP, TRIES)?;
    for _ in 0..ROUNDS {
        shorten(&mut way, |one, other| is_open(clearance, one, other, margin));
    }
    (way.len() > 2).then(|| way[1..way.len() - 1].to_vec())
}

/// Leaves out postures that the way can do without: from each, on to the farthest that can be reached straight.
fn shorten(way: &mut Vec<Posture>, is_open: impl Fn(&Posture, &Posture) -> bool) {
    let mut from = 0;
    while from + 2 < way.len() {
        let to = (from + 2..way.len()).rev().find(|to| is_open(&way[from], &way[*to]));
        if let Some(to) = to {
            way.drain(from + 1..to);
        }
        from += 1;
    }
}

/// Whether the straight way of the joints is clear.
fn is_open(clearance: &Clearance, from: &Posture, to: &Posture, margin: f64) -> bool {
    let length = from.iter().zip(to).map(|(from, to)| (from - to).powi(2)).sum::<f64>().sqrt();
    let steps = (length / (0.5 * STEP)).ceil().max(1.0);
    (1..steps as u32).all(|step| clearance.is_clear(&between(from, to, f64::from(step) / steps), margin))
}

/// The same way with a posture more in the middle of each of its pieces.
pub(crate) fn denser(from: &Posture, vias: &[Posture], to: &Posture) -> Vec<Posture> {
    let mut all = Vec::with_capacity(2 * vias.len() + 1);
    let mut last = from;
    for next in vias.iter().chain([to]) {
        all.extend([between(last, next, 0.5), *next]);
        last = next;
    }
    all.pop();
    all
}

fn between(from: &Posture, to: &Posture, share: f64) -> Posture {
    std::array::from_fn(|joint| from[joint] + share * (to[joint] - from[joint]))
}

fn posture(angles: &[f64]) -> Posture {
    let mut posture = [0.0; crate::MAX_JOINTS];
    posture[..angles.len()].copy_from_slice(angles);
    posture
}

/// Whether there is a path between two postures at all, as far as a long search can tell (the judge of the planner).
pub fn path_exists(clearance: &Clearance, from: &Posture, to: &Posture, margin: f64) -> bool {
    let is_free = |posture: &Posture| clearance.is_clear(posture, margin);
    connect(clearance.mechanism, [from, to], is_free, 0.5 * STEP, 5 * TRIES).is_some()
}

/// The postures of a way that RRT-Connect finds in so many tries, `step` rad apart.
fn connect(
    mechanism: &Mechanism,
    [from, to]: [&Posture; 2],
    is_free: impl Fn(&Posture) -> bool,
    step: f64,
    tries: usize,
) -> Option<Vec<Posture>> {
    let (limits, joints) = (mechanism.limits(), mechanism.joints());
    let random = RefCell::new(Pcg64::seed_from_u64(13));
    let draw = || anywhere(&mut *random.borrow_mut(), &limits, joints)[..joints].to_vec();
    let found = rrt::dual_rrt_connect(
        &from[..joints],
        &to[..joints],
        |angles| is_free(&posture(angles)),
        draw,
        step,
        tries,
    )
    .ok()?;
    Some(found.iter().map(|angles| posture(angles)).collect())
}
