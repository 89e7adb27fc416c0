//! Paths through several postures, for where no single bounce helps: RRT-Connect (Kuffner, LaValle, ICRA 2000) in joint
//! space, then shortcutting.

use crate::budget::Budget;
use crate::numerical_ik::random_posture;
use crate::{Clearance, Mechanism};
use coact_robot::Posture;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::cell::RefCell;

/// Length of a tree's step in joint space, rad. Chosen by hand: longer steps may pass through something thin between two
/// postures that are clear, shorter ones cost more postures.
const STEP: f64 = 0.15;
/// Steps after which the search ends. Chosen by hand.
const TRIES: usize = 4_000;
/// Passes of shortcutting over the path. Chosen by hand.
const SHORTCUT_PASSES: usize = 4;
/// Seed of the trees' random postures: any; fixed, so that the same problem has the same path.
const SEED: u64 = 13;

/// Postures between `from` and `to`, such that the straight lines of the joints between them keep `min_clearance` m from
/// everything: trees are grown from both ends, and the path found is shortened. None when the search ends without a path,
/// and when the straight line itself is clear.
pub(crate) fn find(
    clearance: &Clearance,
    [from, to]: [&Posture; 2],
    min_clearance: f64,
    budget: &Budget,
) -> Option<Vec<Posture>> {
    let is_free = |posture: &Posture| budget.spend(1) && clearance.is_clear(posture, min_clearance);
    let mut path = connect(clearance.mechanism, [from, to], is_free, STEP, TRIES)?;
    for _ in 0..SHORTCUT_PASSES {
        shorten(&mut path, |one, other| is_open(clearance, one, other, min_clearance));
    }
    (path.len() > 2).then(|| path[1..path.len() - 1].to_vec())
}

/// Whether a path between two postures exists, as far as a search can tell that is five times as long as the planner's
/// and takes half its steps. It judges which of the planner's failures had a solution.
pub fn path_exists(clearance: &Clearance, from: &Posture, to: &Posture, min_clearance: f64) -> bool {
    let is_free = |posture: &Posture| clearance.is_clear(posture, min_clearance);
    connect(clearance.mechanism, [from, to], is_free, 0.5 * STEP, 5 * TRIES).is_some()
}

/// The same path with one more posture in the middle of each of its straight lines.
pub(crate) fn refined(from: &Posture, vias: &[Posture], to: &Posture) -> Vec<Posture> {
    let mut all = Vec::with_capacity(2 * vias.len() + 1);
    let mut last = from;
    for next in vias.iter().chain([to]) {
        all.extend([between(last, next, 0.5), *next]);
        last = next;
    }
    all.pop();
    all
}

/// Leaves out the postures that the path can do without: from each on to the farthest one that a straight line reaches.
fn shorten(path: &mut Vec<Posture>, is_open: impl Fn(&Posture, &Posture) -> bool) {
    let mut from = 0;
    while from + 2 < path.len() {
        let to = (from + 2..path.len()).rev().find(|to| is_open(&path[from], &path[*to]));
        if let Some(to) = to {
            path.drain(from + 1..to);
        }
        from += 1;
    }
}

/// Whether the straight line of the joints is clear, looked at every half step.
fn is_open(clearance: &Clearance, from: &Posture, to: &Posture, min_clearance: f64) -> bool {
    let length = from.iter().zip(to).map(|(from, to)| (from - to).powi(2)).sum::<f64>().sqrt();
    let steps = (length / (0.5 * STEP)).ceil().max(1.0);
    (1..steps as u32)
        .all(|step| clearance.is_clear(&between(from, to, f64::from(step) / steps), min_clearance))
}

fn between(from: &Posture, to: &Posture, fraction: f64) -> Posture {
    std::array::from_fn(|joint| from[joint] + fraction * (to[joint] - from[joint]))
}

/// The postures of a path that RRT-Connect finds within so many tries, `step` rad apart.
fn connect(
    mechanism: &Mechanism,
    [from, to]: [&Posture; 2],
    is_free: impl Fn(&Posture) -> bool,
    step: f64,
    tries: usize,
) -> Option<Vec<Posture>> {
    let (limits, joints) = (mechanism.limits(), mechanism.joints());
    let random = RefCell::new(Pcg64::seed_from_u64(SEED));
    let draw = || random_posture(&mut *random.borrow_mut(), &limits, joints)[..joints].to_vec();
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

fn posture(angles: &[f64]) -> Posture {
    let mut posture = [0.0; crate::MAX_JOINTS];
    posture[..angles.len()].copy_from_slice(angles);
    posture
}
