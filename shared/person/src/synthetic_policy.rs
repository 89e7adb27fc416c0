//! A correct partner: chooses at random among what the plan allows now.

use crate::{Activity, Intention, Surroundings, Undertaking, Variation};
use coact_joint_task::Agent;
use coact_period::cycles;
use rand::{Rng, RngExt};
use std::ops::Range;
use std::time::Duration;

/// Fraction of the choices in which the person idles instead. Chosen by hand: the robot then has to act without the
/// person.
const IDLES: f64 = 0.15;
/// How long, cycles. Chosen by hand.
pub(crate) const IDLE_TIME: Range<u64> = cycles(Duration::from_secs(2))..cycles(Duration::from_secs(6));
/// How soon the person thinks again when there is nothing to do, cycles. Not sensitive.
pub(crate) const RETHINK: Range<u64> = cycles(Duration::from_millis(200))..cycles(Duration::from_millis(400));
/// How long the robot must have requested something before the person takes that into account, cycles.
const NOTICED: u64 = cycles(Duration::from_millis(500));

/// How much an activity suggests itself against inserting an own part, which counts 1. Chosen by hand: a person gives
/// mostly when the robot requests something, and then rather gives than requests.
const GIVE_UNASKED: f64 = 0.4;
const GIVE_WHEN_REQUESTED: f64 = 4.0;
const REQUEST: f64 = 0.8;
const REQUEST_WHEN_REQUESTED: f64 = 0.2;

/// What the person does next: receives what the robot gives, or does one of the valid activities, or nothing for a while.
pub(crate) fn choose<R: Rng>(around: &Surroundings, rng: &mut R) -> Undertaking {
    if let Some(intention) = around.receive() {
        return Undertaking::Begin(intention);
    }
    match draw(around, rng, |_| true) {
        None => Undertaking::Await(rng.random_range(RETHINK)),
        Some(_) if rng.random_bool(IDLES) => Undertaking::Rest(rng.random_range(IDLE_TIME)),
        Some(intention) => Undertaking::Begin(intention),
    }
}

/// One of the valid intentions that are `wanted`, drawn with their weights.
pub(crate) fn draw<R: Rng>(
    around: &Surroundings,
    rng: &mut R,
    wanted: impl Fn(&Intention) -> bool,
) -> Option<Intention> {
    let (mut drawn, mut total) = (None, 0.0);
    for chain in 0..around.task.chains.len() {
        for subgoal in 0..around.task.subgoals.len() {
            let found = valid(around, chain, subgoal).filter(|(intention, _)| wanted(intention));
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
fn valid(around: &Surroundings, chain: usize, subgoal: usize) -> Option<(Intention, f64)> {
    let (rule, goal) = (&around.task.chains[chain], &around.task.subgoals[subgoal]);
    let serves = rule.kind == goal.kind && rule.side == goal.side;
    if !serves || !around.parts.is_available(subgoal, around.task) {
        return None;
    }
    let part = around.nearest(rule.kind, rule.from)?;
    let activity = around.activity(chain);
    let weight = weight(around, activity, rule.from, rule.kind)?;
    let part = (activity != Activity::Request).then_some(part);
    let variation = Variation::default();
    Some((Intention { activity, chain, subgoal: Some(subgoal), part, variation }, weight))
}

/// How much an activity with a part of `kind` from the workspace of `from` suggests itself; none: it makes no sense now.
fn weight(around: &Surroundings, activity: Activity, from: Agent, kind: usize) -> Option<f64> {
    let robot = &around.robot;
    let is_requested = robot.requesting_since > 0 && around.tick >= robot.requesting_since + NOTICED;
    match (activity, from) {
        (Activity::Insert, Agent::Person) => Some(1.0),
        (Activity::Give, Agent::Person) if robot.held.is_none() => {
            let robot_has_own = around.nearest(kind, Agent::Robot).is_some();
            let weight = if is_requested { GIVE_WHEN_REQUESTED } else { GIVE_UNASKED };
            (!robot_has_own).then_some(weight)
        }
        (Activity::Request, Agent::Robot) if robot.held.is_none() => {
            let person_has_own = around.own_part(kind).is_some();
            let weight = if is_requested { REQUEST_WHEN_REQUESTED } else { REQUEST };
            (!person_has_own).then_some(weight)
        }
        _ => None,
    }
}
