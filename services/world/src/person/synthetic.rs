//! A correct partner: chooses at random among what the plan allows now.

use super::intention::{Choice, Intention, View};
use super::{Errand, Manner};
use coact_joint_task::Agent;
use rand::{Rng, RngExt};

/// Share of the choices in which the person idles instead.
const IDLES: f64 = 0.15;
/// How long, ms.
pub(super) const IDLE_MS: std::ops::Range<u64> = 2000..6000;
/// How soon the person thinks again when there is nothing to do, ms.
pub(super) const RETHINK_MS: std::ops::Range<u64> = 200..400;

/// What the person does next: takes what the robot offers, or one of the valid actions, or nothing for a while.
pub(crate) fn choose<R: Rng>(view: &View, rng: &mut R) -> Choice {
    if let Some(intention) = view.take_offered() {
        return Choice::Begin(intention);
    }
    match draw(view, rng, |_| true) {
        None => Choice::Rest(rng.random_range(RETHINK_MS)),
        Some(_) if rng.random_bool(IDLES) => Choice::Rest(rng.random_range(IDLE_MS)),
        Some(intention) => Choice::Begin(intention),
    }
}

/// One of the valid intentions that are `wanted`, drawn with their weights.
pub(super) fn draw<R: Rng>(
    view: &View,
    rng: &mut R,
    wanted: impl Fn(&Intention) -> bool,
) -> Option<Intention> {
    let (mut drawn, mut total) = (None, 0.0);
    for chain in 0..view.task.chains.len() {
        for subgoal in 0..view.task.subgoals.len() {
            let found = valid(view, chain, subgoal).filter(|(intention, _)| wanted(intention));
            let Some((intention, weight)) = found else { continue };
            total += weight;
            if rng.random::<f64>() * total < weight {
                drawn = Some(intention);
            }
        }
    }
    drawn
}

/// The intention to serve `subgoal` by `chain` and how much it suggests itself; none when the plan, the place of
/// the part or the state of the robot's hand forbids it.
fn valid(view: &View, chain: usize, subgoal: usize) -> Option<(Intention, f64)> {
    let (rule, goal) = (&view.task.chains[chain], &view.task.subgoals[subgoal]);
    let serves = rule.kind == goal.kind && rule.side == goal.side;
    if !serves || !view.parts.is_available(subgoal, view.task) {
        return None;
    }
    let part = view.nearest(rule.kind, rule.from)?;
    let errand = view.errand(chain);
    let robot_is_empty = view.robot.held.get().is_none();
    let asked = view.robot.asking_since > 0 && view.tick >= view.robot.asking_since + 500;
    let weight = match errand {
        Errand::Mount if rule.from == Agent::Person => 1.0,
        Errand::HandOver if rule.from == Agent::Person && robot_is_empty => {
            let robot_has_own = view.nearest(rule.kind, Agent::Robot).is_some();
            if robot_has_own {
                return None;
            } else if asked {
                4.0
            } else {
                0.4
            }
        }
        Errand::Request if rule.from == Agent::Robot && robot_is_empty => {
            let person_has_own = view.own_part(rule.kind).is_some();
            if person_has_own {
                return None;
            } else if asked {
                0.2
            } else {
                0.8
            }
        }
        _ => return None,
    };
    let part = (errand != Errand::Request).then_some(part);
    Some((Intention { errand, chain, subgoal: Some(subgoal), part, manner: Manner::default() }, weight))
}
