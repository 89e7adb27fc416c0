//! A partner as people are: mostly right, in any order that the plan allows, at times idle or out of sight, at times with
//! words, and now and then wrong.

use crate::undoing::undoing;
use crate::{Activity, Intention, RandomBehaviour, Surroundings, Undertaking, Variation, synthetic_policy};
use coact_joint_task::Agent;
use coact_messages::PartnerError;
use coact_period::{PERIOD_S, cycles};
use coact_random::is_in_burst;
use coact_stage_state::{Flag, Slot};
use rand::{Rng, RngExt};
use std::ops::RangeInclusive;
use std::time::Duration;

/// Fraction of the thoughts of a person who has nothing valid to do in which a mistake is possible at all. Such a person
/// thinks about every 0.3 s, so that a mistake suggests itself every 3 s, as it does between two activities.
const THINKS_OF_MISTAKES: f64 = 0.1;
/// How long until a person notices a mistake, from grasp completion or from when the gesture is fully shown, cycles.
/// Chosen by hand, so that the robot can answer
/// before.
const NOTICES: RangeInclusive<u64> = cycles(Duration::from_secs(1))..=cycles(Duration::from_secs(3));
/// Intervals in each of which the tracker may lose the hand once, cycles.
const DROPOUT_INTERVAL: u64 = cycles(Duration::from_millis(500));
/// For how long it does, cycles: 3 to 18 frames of a camera of 60 Hz.
const DROPOUT: RangeInclusive<u64> = cycles(Duration::from_millis(50))..=cycles(Duration::from_millis(300));

/// What the person does next: receives what the robot gives, makes a mistake, idles, or does one of the valid activities;
/// one of those may be hidden, or come with words. At times a step is undone.
pub(crate) fn choose<R: Rng>(
    behaviour: &RandomBehaviour,
    around: &Surroundings,
    can_hide: &dyn Fn(&Intention) -> bool,
    rng: &mut R,
) -> Undertaking {
    if let Some(intention) = around.receive() {
        return Undertaking::Begin(intention);
    }
    let valid = synthetic_policy::draw(around, rng, |_| true);
    let drawn: f64 = rng.random::<f64>() / if valid.is_some() { 1.0 } else { THINKS_OF_MISTAKES };
    let RandomBehaviour { idle, goal, request, means, .. } = *behaviour;
    let wrong = goal + request + means;
    let in_silence = wrong + behaviour.hidden;
    let special = match drawn {
        drawn if drawn < goal => one_of(around, rng, wrong_goal),
        drawn if drawn < goal + request => asking(behaviour, around, rng, wrong_request),
        drawn if drawn < wrong => asking(behaviour, around, rng, wrong_means),
        drawn if drawn < in_silence => hidden(around, can_hide, rng),
        drawn if drawn < in_silence + behaviour.words => spoken(around, rng),
        drawn if drawn < in_silence + behaviour.words + behaviour.undoes => one_of(around, rng, undoing),
        _ => None,
    };
    let idles = drawn >= 1.0 - idle;
    match special.or(valid) {
        None => Undertaking::Await(rng.random_range(synthetic_policy::RETHINK)),
        Some(_) if idles && special.is_none() => {
            Undertaking::Rest(rng.random_range(synthetic_policy::IDLE_TIME))
        }
        Some(intention) => Undertaking::Begin(intention),
    }
}

/// To take one of the parts that may be taken, behind an occluder.
fn hidden<R: Rng>(
    around: &Surroundings,
    can_hide: &dyn Fn(&Intention) -> bool,
    rng: &mut R,
) -> Option<Intention> {
    let behind = |taking: Intention| Intention {
        variation: Variation { hidden: Flag::Set, ..taking.variation },
        ..taking
    };
    synthetic_policy::draw(around, rng, |intention| can_hide(&behind(*intention))).map(behind)
}

/// To ask for what is wrong, at times with words: a bare hand does not show what it asks for.
fn asking<R: Rng>(
    behaviour: &RandomBehaviour,
    around: &Surroundings,
    rng: &mut R,
    make: impl Fn(&Surroundings, usize) -> Option<Intention>,
) -> Option<Intention> {
    let asked = one_of(around, rng, make)?;
    let is_told = behaviour.aloud > 0.0 && rng.random_bool(behaviour.aloud);
    Some(if is_told { told(asked, around, rng) } else { asked })
}

/// The same with one of the sentences of the task that mean it, if there is one.
fn told<R: Rng>(intention: Intention, around: &Surroundings, rng: &mut R) -> Intention {
    let phrases = around.task.chains[intention.chain].says.len();
    if phrases == 0 {
        return intention;
    }
    let phrase = Slot::of(rng.random_range(0..phrases));
    Intention { variation: Variation { phrase, ..intention.variation }, ..intention }
}

/// To do one of the valid activities of which the task knows how they are spoken of, and to say so.
fn spoken<R: Rng>(around: &Surroundings, rng: &mut R) -> Option<Intention> {
    let phrases = |intention: &Intention| around.task.chains[intention.chain].says.len();
    let chosen = synthetic_policy::draw(around, rng, |intention| phrases(intention) > 0)?;
    Some(told(chosen, around, rng))
}

/// How long after grasp completion the person notices a mistake, cycles.
pub(crate) fn notices_after<R: Rng>(rng: &mut R) -> u64 {
    rng.random_range(NOTICES)
}

/// Whether the tracker has lost the hand at `tick`; `rng_of` makes the generator of an interval of time.
pub(crate) fn is_lost<R: Rng>(behaviour: &RandomBehaviour, tick: u64, rng_of: impl Fn(u64) -> R) -> bool {
    let mut rng = rng_of(tick / DROPOUT_INTERVAL);
    let probability = (behaviour.dropouts * PERIOD_S * DROPOUT_INTERVAL as f64).min(1.0);
    is_in_burst(&mut rng, probability, tick, DROPOUT_INTERVAL, DROPOUT)
}

/// To take an own part for a goal that is not available, among those that are `wanted`.
pub(crate) fn wrong_taking<R: Rng>(
    around: &Surroundings,
    rng: &mut R,
    wanted: impl Fn(&Intention) -> bool,
) -> Option<Intention> {
    one_of(around, rng, |around, chain| wrong_goal(around, chain).filter(&wanted))
}

/// One of the intentions that `make` finds among the chains.
fn one_of<R: Rng>(
    around: &Surroundings,
    rng: &mut R,
    make: impl Fn(&Surroundings, usize) -> Option<Intention>,
) -> Option<Intention> {
    let possible = || (0..around.task.chains.len()).filter_map(|chain| make(around, chain));
    let count = possible().count();
    if count == 0 { None } else { possible().nth(rng.random_range(0..count)) }
}

/// To take an own part for a goal that is not available.
fn wrong_goal(around: &Surroundings, chain: usize) -> Option<Intention> {
    let intention = around.taking(chain, around.goal(chain))?;
    is_wrong_goal(around, &intention).then_some(intention)
}

/// To request a part of the robot's whose turn has not come, while nothing else could be meant: a gesture names no part.
fn wrong_request(around: &Surroundings, chain: usize) -> Option<Intention> {
    let intention = request(around, chain)?;
    let possible = around.nearest(around.task.chains[chain].kind, Agent::Robot).is_some();
    (possible && is_wrong_goal(around, &intention) && !something_to_request(around)).then_some(intention)
}

/// To request a part that lies before oneself, while nothing else could be meant.
fn wrong_means(around: &Surroundings, chain: usize) -> Option<Intention> {
    let intention = request(around, chain)?;
    let wrong = around.error_of(&intention) == PartnerError::AtHand;
    (wrong && !something_to_request(around)).then_some(intention)
}

fn is_wrong_goal(around: &Surroundings, intention: &Intention) -> bool {
    matches!(around.error_of(intention), PartnerError::Early | PartnerError::Done)
}

fn request(around: &Surroundings, chain: usize) -> Option<Intention> {
    let requests = around.activity(chain) == Activity::Request && around.robot.held.is_none();
    requests.then(|| Intention {
        activity: Activity::Request,
        chain,
        subgoal: around.goal(chain),
        part: None,
        variation: Variation::default(),
    })
}

/// Whether a part of the robot's is needed on the person's side now.
fn something_to_request(around: &Surroundings) -> bool {
    let goals = &around.task.subgoals;
    let needed = |goal: usize| {
        goals[goal].side == Agent::Person
            && around.parts.is_available(goal, around.task)
            && around.nearest(goals[goal].kind, Agent::Robot).is_some()
    };
    (0..goals.len()).any(needed)
}
