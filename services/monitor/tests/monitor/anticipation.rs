//! Was the right decision there before the grasp? Hand-made truth and frames.
#![allow(clippy::unwrap_used)]

use crate::support::*;
use coact_messages::{FieldFrame, LayerKind, PartnerError, Truth};
use coact_monitor::Anticipation;
use coact_run_records::{ActionEvent, AnticipationReport, Event};

/// Plays truth and frames of the same ticks, and gives the actions that were settled.
fn play(ticks: impl IntoIterator<Item = (Truth, Box<FieldFrame>)>) -> Vec<ActionEvent> {
    let mut anticipation = Anticipation::new(&task(), intentions());
    let mut events = Vec::new();
    for (truth, frame) in ticks {
        anticipation.observe(&truth, &frame, &mut events);
    }
    anticipation.finish(&mut events);
    events.iter().filter_map(Event::as_action).cloned().collect()
}

/// One action from onset 100 to grasp 800, then at rest from 1500; `peak` gives the frame of each tick.
fn one_action(chain: u32, subgoal: u32, peak: impl Fn(u64) -> Box<FieldFrame>) -> ActionEvent {
    let truth = |cycle| match cycle {
        0..100 => resting(cycle, &acting(cycle, 0, 0, 0, 0, 0)),
        100..800 => acting(cycle, 1, chain, subgoal, 100, 0),
        800..1500 => acting(cycle, 1, chain, subgoal, 100, 800),
        _ => resting(cycle, &acting(cycle, 1, chain, subgoal, 100, 800)),
    };
    let mut actions = play((0..2000).map(|cycle| (truth(cycle), peak(cycle))));
    assert_eq!(actions.len(), 1);
    actions.remove(0)
}

fn from(start: u64, cycle: u64, action: usize) -> Box<FieldFrame> {
    if cycle >= start { decided(cycle, action, start) } else { frame(cycle) }
}

#[test]
fn right_decision_leads_by_the_time_from_its_crossing_to_the_grasp() {
    let event = one_action(MOUNT, LID, |cycle| from(600, cycle, STEADY_LID));
    assert_eq!((event.onset_ms, event.grasp_ms, event.decided_ms), (100, 800, Some(600)));
    assert_eq!(event.lead_ms, Some(200));
    assert_eq!(event.decided.as_deref(), Some("steady: lid"));
    assert!(event.anticipated() && !event.wrong());
}

#[test]
fn a_mistake_is_answered_rightly_by_its_correction() {
    let mistaken = |mut truth: Truth| {
        truth.error = PartnerError::Early as u32;
        truth
    };
    let answered = |action: usize| {
        let ticks = (0..1200).map(|cycle| {
            let grasp = if cycle >= 800 { 800 } else { 0 };
            let truth = mistaken(acting(cycle, u32::from(cycle >= 100), MOUNT, HINGE, 100, grasp));
            (truth, from(600, cycle, action))
        });
        play(ticks).remove(0)
    };
    assert!(answered(OBJECT_TO_HINGE).anticipated());
    let helped = answered(RECEIVE_HINGE);
    assert!(helped.wrong() && helped.expected.as_deref() == Some("object: hinge"), "{helped:?}");
}

#[test]
fn a_mistake_whose_turn_comes_on_the_way_is_answered_like_any_action() {
    let ticks = (0..1200).map(|cycle| {
        let grasp = if cycle >= 800 { 800 } else { 0 };
        let mut truth = acting(cycle, u32::from(cycle >= 100), MOUNT, LID, 100, grasp);
        truth.error = if cycle < 400 { PartnerError::Early } else { PartnerError::None } as u32;
        (truth, from(600, cycle, STEADY_LID))
    });
    assert!(play(ticks).remove(0).anticipated());
}

#[test]
fn hand_that_turns_in_mid_reach_is_answered_by_what_it_is_after_at_last() {
    let answered = |first: usize, then: usize| {
        let ticks = (0..1200).map(|cycle| {
            let grasp = if cycle >= 800 { 800 } else { 0 };
            let (chain, subgoal) = if cycle < 400 { (MOUNT, LID) } else { (PASS, HINGE) };
            let truth = acting(cycle, u32::from(cycle >= 100), chain, subgoal, 100, grasp);
            (truth, if cycle < 550 { from(200, cycle, first) } else { from(550, cycle, then) })
        });
        play(ticks).remove(0)
    };
    let followed = answered(STEADY_LID, RECEIVE_HINGE);
    assert_eq!(followed.subgoal, "hinge");
    assert_eq!((followed.anticipated(), followed.lead_ms), (true, Some(250)));
    assert!(answered(STEADY_LID, STEADY_LID).wrong());
}

#[test]
fn bringing_what_the_next_step_needs_answers_by_understanding() {
    let brings = |understood: bool| {
        one_action(MOUNT, LID, move |cycle| {
            let mut frame = from(600, cycle, GIVE_HINGE);
            if understood && cycle >= 500 {
                let goal = frame.populations(LayerKind::Intention).nth(MOUNTING_LID).unwrap();
                frame.since[goal] = 500;
            }
            frame
        })
    };
    assert_eq!((brings(true).anticipated(), brings(true).lead_ms), (true, Some(300)));
    assert!(!brings(false).correct);
}

#[test]
fn wrong_decision_during_the_reach_is_counted_as_wrong() {
    let event = one_action(MOUNT, LID, |cycle| from(600, cycle, RECEIVE_HINGE));
    assert_eq!(event.expected.as_deref(), Some("steady: lid"));
    assert_eq!(event.decided.as_deref(), Some("receive: hinge"));
    assert!(event.wrong() && event.decided_before_grasp() && !event.anticipated());
}

#[test]
fn what_the_robot_was_doing_before_the_reach_is_no_answer() {
    let event = one_action(MOUNT, LID, |cycle| from(50, cycle, REQUEST));
    assert_eq!((event.decided, event.lead_ms), (None, None));
}

#[test]
fn decision_after_the_grasp_has_a_negative_lead() {
    let event = one_action(PASS, HINGE, |cycle| from(950, cycle, RECEIVE_HINGE));
    assert_eq!(event.lead_ms, Some(-150));
    assert!(event.correct && !event.anticipated() && !event.wrong());
}

#[test]
fn decision_after_the_hand_came_to_rest_is_none() {
    let event = one_action(PASS, HINGE, |cycle| from(1600, cycle, RECEIVE_HINGE));
    assert_eq!(event.decided, None);
}

#[test]
fn peak_that_does_not_stay_does_not_count_and_its_return_does() {
    let event = one_action(MOUNT, LID, |cycle| match cycle {
        300..500 => decided(cycle, STEADY_LID, 300),
        700.. => decided(cycle, STEADY_LID, 700),
        _ => frame(cycle),
    });
    assert_eq!(event.lead_ms, Some(100));
    let event = one_action(MOUNT, LID, |cycle| match cycle {
        300..799 => decided(cycle, STEADY_LID, 300),
        _ => frame(cycle),
    });
    assert_eq!(event.decided, None);
}

#[test]
fn changed_mind_counts_as_it_stands_at_the_grasp() {
    let event = one_action(MOUNT, LID, |cycle| match cycle {
        300..500 => decided(cycle, RECEIVE_HINGE, 300),
        _ => from(500, cycle, STEADY_LID),
    });
    assert!(event.anticipated());
    assert_eq!(event.lead_ms, Some(300));
}

#[test]
fn goal_counts_where_no_action_complements_it() {
    // The hinge needs no holding: the inferred goal is what can be measured.
    let inferred = |population| {
        move |cycle| match cycle {
            0..400 => frame(cycle),
            _ => with_peak(cycle, LayerKind::Intention, population, 400),
        }
    };
    let event = one_action(MOUNT, HINGE, inferred(0));
    assert_eq!(event.expected.as_deref(), Some("mount: hinge"));
    assert!(event.anticipated());
    let event = one_action(MOUNT, HINGE, inferred(1));
    assert_eq!(event.decided.as_deref(), Some("mount: lid"));
    assert!(event.wrong());
}

#[test]
fn frames_that_were_lost_on_the_way_change_nothing() {
    let ticks = (0..1500).filter(|cycle| cycle % 20 == 7 || *cycle == 120);
    let truth = |cycle| acting(cycle, 1, MOUNT, LID, 100, if cycle >= 800 { 800 } else { 0 });
    let actions = play(ticks.map(|cycle| (truth(cycle), from(600, cycle, STEADY_LID))));
    assert_eq!(actions[0].lead_ms, Some(200));
}

#[test]
fn action_that_is_broken_off_gives_no_event_and_the_next_one_does() {
    let ticks = (0..1000).map(|cycle| match cycle {
        0..300 => (acting(cycle, 1, MOUNT, LID, 0, 0), frame(cycle)),
        300..700 => (acting(cycle, 2, PASS, HINGE, 300, 0), from(500, cycle, RECEIVE_HINGE)),
        _ => (acting(cycle, 2, PASS, HINGE, 300, 700), from(500, cycle, RECEIVE_HINGE)),
    });
    let actions = play(ticks);
    assert_eq!(actions.len(), 1);
    assert_eq!((actions[0].action, actions[0].lead_ms), (2, Some(200)));
}

#[test]
fn action_that_is_in_the_report_already_is_not_reported_again() {
    let mut anticipation = Anticipation::new(&task(), intentions());
    anticipation.resume(1);
    let mut events = Vec::new();
    for cycle in 700..900 {
        anticipation.observe(
            &acting(cycle, 1, MOUNT, LID, 100, 600),
            &from(1, cycle, STEADY_LID),
            &mut events,
        );
    }
    anticipation.finish(&mut events);
    assert!(events.is_empty());
}

#[test]
fn shares_and_leads_are_summed_up_over_expected_answers_only() {
    let event = |action, lead: Option<i64>, correct, expected: bool| {
        let text = |yes: bool| yes.then(String::new);
        Event::Action(ActionEvent {
            action,
            chain: String::new(),
            kind: String::new(),
            subgoal: String::new(),
            onset_ms: 0,
            grasp_ms: 1000,
            decided_ms: lead.map(|lead| (1000 - lead) as u64),
            lead_ms: lead,
            decided: text(lead.is_some()),
            expected: text(expected),
            correct,
        })
    };
    let report = AnticipationReport::new(&[
        event(1, Some(300), true, true),
        event(2, Some(-50), true, true),
        event(3, Some(200), false, true),
        event(4, None, false, true),
        event(5, None, false, false),
    ]);
    assert_eq!((report.actions, report.decided_before_grasp, report.correct), (4, 2, 1));
    let lead = report.lead_ms;
    assert_eq!((lead.p5, lead.p50, lead.p95), (Some(-50), Some(-50), Some(300)));
    assert_eq!(report.events.len(), 5);
}
