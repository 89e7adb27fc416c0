//! The experiments of the chapter and of its discussion, each a script that drives the person and the scene only: what
//! the robot decides and detects, in order, whatever the seed.
#![allow(clippy::unwrap_used)]

use crate::shipped::{configuration, decision, settings};
use coact_lockstep::Lockstep;
use coact_messages::LayerKind;
use coact_period::CYCLES_PER_SECOND;

/// Seeds in the order in which they are drawn; `COACT_SEEDS=100` tries as many.
fn seeds() -> std::ops::RangeInclusive<u64> {
    1..=std::env::var("COACT_SEEDS").map_or(3, |seeds| seeds.parse().unwrap())
}

/// Each error that is noticed in EML, and each decision, in order.
fn story(scenario: &str, seed: u64, seconds: u64) -> Vec<String> {
    let script = format!("script:{}", configuration().join(format!("scenarios/{scenario}.toml")).display());
    let mut stages = Lockstep::new(&settings(seed, &script)).unwrap();
    let (mut told, mut decided, mut wrong) = (Vec::new(), None, Vec::new());
    while stages.ticks() < seconds * CYCLES_PER_SECOND {
        stages.step();
        let now = decision(&stages).map(str::to_owned);
        if now != decided {
            told.extend(now.clone());
            decided = now;
        }
        let errors = peaks(&stages, LayerKind::ErrorMonitoring);
        told.extend(
            errors.iter().filter(|error| !wrong.contains(*error)).map(|error| format!("error: {error}")),
        );
        wrong = errors;
        for layer in [LayerKind::ActionSimulation, LayerKind::Intention, LayerKind::ActionExecution] {
            assert!(peaks(&stages, layer).len() <= 1, "{scenario}, seed {seed}: two peaks in {layer:?}");
        }
    }
    told
}

fn peaks(stages: &Lockstep, layer: LayerKind) -> Vec<String> {
    let (plan, frame) = (stages.plan(), &stages.frame);
    let standing = plan.layer(layer).populations.clone().filter(|&population| frame.signal[population] > 0.5);
    standing.map(|population| plan.populations[population].label.clone()).collect()
}

/// Asserts, for each seed, that `expected` happens in this order and that nothing that begins with one of `never` does.
fn check(scenario: &str, seconds: u64, expected: &[&str], never: &[&str]) {
    for seed in seeds() {
        let told = story(scenario, seed, seconds);
        let mut rest = told.iter();
        for step in expected {
            assert!(
                rest.any(|own| own == step),
                "{scenario}, seed {seed}: no \"{step}\" in its turn in {told:#?}"
            );
        }
        for event in never {
            let happened = told.iter().any(|own| own.starts_with(event));
            assert!(!happened, "{scenario}, seed {seed}: \"{event}\" in {told:#?}");
        }
    }
}

#[test]
fn the_robot_takes_the_initiative_and_infers_goals_from_grips() {
    let expected = [
        "request: wheel on the robot's side",
        "steady the base: wheel on the person's side",
        "request: wheel on the robot's side",
        "receive: wheel on the robot's side",
        "insert: wheel on the robot's side",
    ];
    check("proactive", 35, &expected, &["error"]);
}

#[test]
fn a_hidden_action_is_understood_from_memory_and_the_future_need_is_served() {
    let expected = ["insert: wheel on the robot's side", "give: nut on the person's side"];
    check("occlusion", 8, &expected, &["error", "steady", "receive"]);
}

#[test]
fn errors_are_told_and_requests_are_understood_from_the_context() {
    let expected = [
        "error: column 4 in its hole",
        "correct: column 4 in its hole",
        "receive: column 1 in its hole",
        "insert: column 1 in its hole",
        "error: column 3 in its hole",
        "correct: column 3 in its hole",
        "steady the base: column 4 in its hole",
    ];
    check("errors-and-requests", 40, &expected, &["give", "steady the base: column 3"]);
}

#[test]
fn what_lies_at_hand_is_pointed_to() {
    let expected = ["error: at hand: nut", "point to: nut", "steady the base: nut on the person's side"];
    check("means-error", 14, &expected, &["give", "error: done", "error: nut"]);
}

#[test]
fn a_lost_part_is_replaced_by_another_of_its_kind() {
    let expected = ["insert: nut on the robot's side", "error: lost: nut", "give: nut on the person's side"];
    check("lost-part", 14, &expected, &["request: nut", "report"]);
}

#[test]
fn a_lost_part_that_only_the_person_has_is_asked_for() {
    let expected = [
        "insert: wheel on the robot's side",
        "error: lost: wheel",
        "request: wheel on the robot's side",
        "receive: wheel on the robot's side",
        "insert: wheel on the robot's side",
        "insert: nut on the robot's side",
    ];
    check("lost-last-part", 45, &expected, &["report"]);
}

#[test]
fn without_any_observation_the_robot_decides_by_itself_but_stands_for_nobody_knows_where_the_person_is() {
    let expected = ["insert: wheel on the robot's side"];
    check("absent", 14, &expected, &["error", "steady", "receive", "insert: nut"]);
}

#[test]
fn late_observation_changes_the_decision() {
    let expected = ["request: wheel on the robot's side", "steady the base: wheel on the person's side"];
    check("late", 8, &expected, &["error", "receive"]);
}

#[test]
fn words_are_understood_as_movements_are() {
    let expected = [
        "give: nut on the person's side",
        "steady the base: nut on the person's side",
        "receive: wheel on the robot's side",
        "insert: wheel on the robot's side",
    ];
    check("words", 30, &expected, &["error"]);
}

#[test]
fn a_hand_that_belies_the_words_wins_in_the_end() {
    let expected = ["receive: wheel on the robot's side", "steady the base: wheel on the person's side"];
    check("conflict", 8, &expected, &["error", "insert"]);
}
