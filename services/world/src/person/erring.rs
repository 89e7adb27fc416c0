//! A partner as people are: mostly right, in any order that the plan allows, at times idle or out of sight, at times with
//! words, and now and then wrong.

use super::intention::{Choice, Intention, View};
use super::rates::Rates;
use super::{Errand, Manner, synthetic};
use crate::slot::Slot;
use coact_joint_task::{Act, Agent};
use coact_messages::PartnerError;
use rand::{Rng, RngExt};

/// A person who waits looks every 0.3 s whether there is something to do; a mistake suggests itself every 3 s.
const IMPATIENT: f64 = 0.1;
/// How long a person errs before noticing it, beyond the grasp or beyond the gesture that is fully shown, ms.
const NOTICES_MS: std::ops::RangeInclusive<u64> = 1000..=3000;
/// Slots of time in each of which the tracker may lose the hand once, ms, and for how long it does.
const SLOT_MS: u64 = 500;
const BURST_MS: std::ops::RangeInclusive<u64> = 50..=300;

/// What the person does next: takes what the robot offers, errs, idles, or does one of the valid actions; one of those
/// may be hidden, or come with words.
pub(crate) fn choose<R: Rng>(
    rates: &Rates,
    view: &View,
    can_hide: &dyn Fn(&Intention) -> bool,
    rng: &mut R,
) -> Choice {
    if let Some(intention) = view.take_offered() {
        return Choice::Begin(intention);
    }
    let valid = synthetic::draw(view, rng, |_| true);
    let drawn: f64 = rng.random::<f64>() / if valid.is_some() { 1.0 } else { IMPATIENT };
    let wrong = rates.goal + rates.ask + rates.means;
    let special = match drawn {
        drawn if drawn < rates.goal => one_of(view, rng, wrong_goal),
        drawn if drawn < rates.goal + rates.ask => one_of(view, rng, wrong_request),
        drawn if drawn < wrong => one_of(view, rng, wrong_means),
        drawn if drawn < wrong + rates.hidden => hidden(view, can_hide, rng),
        drawn if drawn < wrong + rates.hidden + rates.words => spoken(view, rng),
        _ => None,
    };
    let idles = drawn >= 1.0 - rates.idle;
    match special.or(valid) {
        None => Choice::Rest(rng.random_range(synthetic::RETHINK_MS)),
        Some(_) if idles && special.is_none() => Choice::Rest(rng.random_range(synthetic::IDLE_MS)),
        Some(intention) => Choice::Begin(intention),
    }
}

/// To take one of the parts that may be taken, behind something.
fn hidden<R: Rng>(view: &View, can_hide: &dyn Fn(&Intention) -> bool, rng: &mut R) -> Option<Intention> {
    let behind = |taking: Intention| Intention { manner: Manner { hidden: 1, ..taking.manner }, ..taking };
    synthetic::draw(view, rng, |intention| can_hide(&behind(*intention))).map(behind)
}

/// To do one of the valid actions of which the task knows how they are spoken of, and to say so.
fn spoken<R: Rng>(view: &View, rng: &mut R) -> Option<Intention> {
    let phrases = |intention: &Intention| view.task.chains[intention.chain].says.len();
    let told = synthetic::draw(view, rng, |intention| phrases(intention) > 0)?;
    let phrase = Slot::of(rng.random_range(0..phrases(&told)));
    Some(Intention { manner: Manner { phrase, ..told.manner }, ..told })
}

/// How long after grasp completion the person who errs notices, ms.
pub(super) fn notices<R: Rng>(rng: &mut R) -> u64 {
    rng.random_range(NOTICES_MS)
}

/// Whether the tracker has lost the hand at `tick`; `slot` makes the generator of a slot of time.
pub(super) fn is_lost<R: Rng>(rates: &Rates, tick: u64, slot: impl Fn(u64) -> R) -> bool {
    let mut rng = slot(tick / SLOT_MS);
    let happens = rng.random_bool((rates.dropouts * 1e-3 * SLOT_MS as f64).min(1.0));
    let length = rng.random_range(BURST_MS);
    let begins = rng.random_range(0..=SLOT_MS - length);
    happens && (begins..begins + length).contains(&(tick % SLOT_MS))
}

/// One of the intentions that `make` finds among the chains.
fn one_of<R: Rng>(
    view: &View,
    rng: &mut R,
    make: impl Fn(&View, usize) -> Option<Intention>,
) -> Option<Intention> {
    let possible = || (0..view.task.chains.len()).filter_map(|chain| make(view, chain));
    let count = possible().count();
    if count == 0 { None } else { possible().nth(rng.random_range(0..count)) }
}

/// To take an own part for a goal that is not available.
fn wrong_goal(view: &View, chain: usize) -> Option<Intention> {
    let rule = &view.task.chains[chain];
    let grasps = matches!(rule.act, Act::Grasp { .. }) && rule.from == Agent::Person;
    let part = view.own_part(rule.kind).filter(|_| grasps)?;
    let intention = Intention {
        errand: view.errand(chain),
        chain,
        subgoal: view.goal(chain),
        part: Some(part),
        manner: Manner::default(),
    };
    is_wrong_goal(view, &intention).then_some(intention)
}

/// To ask for a part of the robot's whose turn has not come, while nothing else could be meant: a gesture names no part.
fn wrong_request(view: &View, chain: usize) -> Option<Intention> {
    let intention = request(view, chain)?;
    let possible = view.nearest(view.task.chains[chain].kind, Agent::Robot).is_some();
    (possible && is_wrong_goal(view, &intention) && !something_to_ask_for(view)).then_some(intention)
}

/// To ask for a part that lies before oneself, while nothing else could be meant.
fn wrong_means(view: &View, chain: usize) -> Option<Intention> {
    let intention = request(view, chain)?;
    let wrong = view.error_of(&intention) == PartnerError::AtHand;
    (wrong && !something_to_ask_for(view)).then_some(intention)
}

fn is_wrong_goal(view: &View, intention: &Intention) -> bool {
    matches!(view.error_of(intention), PartnerError::Early | PartnerError::Done)
}

fn request(view: &View, chain: usize) -> Option<Intention> {
    let asks = view.errand(chain) == Errand::Request && view.robot.held.get().is_none();
    asks.then(|| Intention {
        errand: Errand::Request,
        chain,
        subgoal: view.goal(chain),
        part: None,
        manner: Manner::default(),
    })
}

/// Whether a part of the robot's is needed on the person's side now.
fn something_to_ask_for(view: &View) -> bool {
    let goals = &view.task.subgoals;
    let asked = |goal: usize| {
        goals[goal].side == Agent::Person
            && view.parts.is_available(goal, view.task)
            && view.nearest(goals[goal].kind, Agent::Robot).is_some()
    };
    (0..goals.len()).any(asked)
}
