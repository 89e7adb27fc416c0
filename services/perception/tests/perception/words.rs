//! What is said is evidence for what is meant, as far as the words go.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::{self, Stage};
use coact_joint_task::Act;

/// Evidence for each spoken chain some time after a sentence, strongest first.
fn after(sentence: &str, ticks: u64) -> Vec<(String, f64)> {
    let mut stage = Stage::new();
    stage.sample.heard.hear(stage.tick, sentence);
    stage.run(ticks, |_, _| {});
    let words = (0..stage.task.acts.len()).filter(|act| matches!(stage.task.acts[*act], Act::Word(_)));
    let mut found: Vec<_> = words.map(|act| (stage.task.act_name(act), stage.percept.act[act])).collect();
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found
}

#[test]
fn a_sentence_is_evidence_for_one_chain_whatever_stands_around_its_words() {
    let cases = [
        ("Give me the wheel!", "says: request: wheel"),
        ("well, could you please give me now a nut", "says: request: nut"),
        ("could you pass me column one?", "says: request: column 1"),
        ("I give you the wheel", "says: hand over: wheel"),
        ("so here is the top floor", "says: hand over: top floor"),
        ("I INSERT THE COLUMN 4", "says: insert: column 4"),
    ];
    for (sentence, meant) in cases {
        let found = after(sentence, 150);
        assert_eq!(found[0].0, meant, "{sentence}: {:?}", &found[..3]);
        assert!(found[0].1 > 0.95 && found[1].1 < 0.2, "{sentence}: {:?}", &found[..3]);
    }
}

#[test]
fn what_names_no_part_spreads_and_what_says_nothing_is_nothing() {
    let found = after("give me that", 150);
    assert!(
        found[..7].iter().all(|(name, fit)| name.contains("request") && (0.3..0.8).contains(fit)),
        "{found:?}"
    );
    assert!(found[7].1 < 0.2, "{found:?}");
    for sentence in ["hello robot", "", "the", "wheel", "?!"] {
        assert!(after(sentence, 150)[0].1 < 0.2, "{sentence}: {:?}", &after(sentence, 150)[..2]);
    }
}

#[test]
fn a_sentence_rises_at_once_stays_and_is_forgotten() {
    assert!(after("give me the wheel", 30)[0].1 > 0.3);
    assert!(after("give me the wheel", 2900)[0].1 > 0.95);
    assert!(after("give me the wheel", 3400)[0].1 < 0.05);
}

#[test]
fn nothing_of_an_old_sentence_comes_back_with_a_replacement() {
    let mut stage = Stage::new();
    stage.sample.heard.hear(stage.tick, "give me the wheel");
    stage.run(4000, |_, _| {});
    stage.perception = support::perception(&stage.task);
    stage.perception.resume(&stage.percept).unwrap();
    let words = |stage: &Stage| {
        let acts = stage.task.acts.iter().zip(&stage.percept.act);
        acts.filter(|(act, _)| matches!(act, Act::Word(_))).map(|(_, fit)| *fit).fold(0.0, f64::max)
    };
    stage.run(500, |stage, _| assert!(words(stage) < 0.05));
}
