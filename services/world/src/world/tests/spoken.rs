//! The partner who says what an action means.

use super::mistakes::run;
use coact_person::Activity;

#[test]
fn each_chosen_action_is_heard_at_its_onset_as_a_sentence_of_its_meaning() {
    let (mut heard, mut silent, mut sentences) = (0, 0, 0);
    run(1, 300, "idle=0,goal=0,request=0,means=0,hidden=0,words=1", |tick, world, out, before| {
        let new = out.sample.heard.sentences - std::mem::replace(&mut sentences, out.sample.heard.sentences);
        let begins = out.truth.actions != before.actions;
        // To receive what the robot gives is no choice.
        let chosen = begins && world.simulation.person.activity() != Activity::Receive;
        assert_eq!(new, u64::from(chosen), "tick {tick}");
        if chosen {
            let (said, chain) = (out.sample.heard.sentence(), &world.task.chains[out.truth.chain as usize]);
            assert!(chain.says.iter().any(|phrase| phrase == said), "{said:?} for {}", chain.name);
            assert_eq!(out.sample.heard.cycle, tick);
        }
        (heard, silent) = (heard + u32::from(chosen), silent + u32::from(begins && !chosen));
    });
    assert!(heard >= 10, "{heard} sentences, {silent} actions without");
}
