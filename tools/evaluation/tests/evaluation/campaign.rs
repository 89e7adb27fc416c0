//! Assemblies with random partners, judged.
#![allow(clippy::unwrap_used)]

use coact_control::PlannerDelay;
use coact_evaluation::{
    Ablation, Campaign, EvaluationReport, Inference, NetworkVariant, Trial, draw_fluency, draw_leads, run,
};
use coact_joint_task::NetworkPlan;
use coact_messages::LayerKind;
use coact_pipeline::{RunSettings, WorldMode};
use coact_run_records::{Occupation, Waiting};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// One assembly of the shipped task by one person, on one thread.
fn campaign<'a>(settings: &'a RunSettings, network: &'a NetworkVariant) -> Campaign<'a> {
    Campaign {
        settings,
        tasks: &[],
        people: &[],
        network,
        guarded: true,
        planner_delay: PlannerDelay::None,
        trials: 1,
        assemblies: 1,
        threads: 1,
    }
}

fn settings(partner: &str) -> RunSettings {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    RunSettings { partner: partner.into(), world: WorldMode::Kinematic, ..RunSettings::shipped(&folder) }
}

fn trials(partner: &str, network: &NetworkVariant, trials: u64, threads: usize) -> Vec<Trial> {
    run(&Campaign { trials, threads, ..campaign(&settings(partner), network) }, || {}).unwrap()
}

#[test]
fn same_seeds_give_the_same_trials_with_any_number_of_threads() {
    let done = AtomicUsize::new(0);
    let (settings, network) = (settings("random:goal=0.2"), NetworkVariant::default());
    let campaign = Campaign { trials: 2, threads: 2, ..campaign(&settings, &network) };
    let one = run(&campaign, || _ = done.fetch_add(1, Ordering::Relaxed)).unwrap();
    assert_eq!(done.into_inner(), 2);
    assert_eq!(one.iter().map(|trial| trial.seed).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(one, trials("random:goal=0.2", &network, 2, 1));
    assert!(one.iter().all(|trial| trial.actions.len() >= 3), "every action is recorded: {one:?}");
    let actions = || one.iter().flat_map(|trial| &trial.actions);
    assert!(actions().any(|action| action.error.is_some()));
    assert!(actions().all(|action| action.turn.is_none()), "nobody changes the mind who is not said to");
    assert_eq!(EvaluationReport::new(&network, &one).changes_of_mind, None);
}

#[test]
fn a_robot_without_anticipation_answers_later() {
    let reactive = NetworkVariant { reactive: true, ..NetworkVariant::default() };
    let (one, other) =
        (trials("synthetic", &NetworkVariant::default(), 2, 2), trials("synthetic", &reactive, 2, 2));
    let (with, without) =
        (EvaluationReport::new(&NetworkVariant::default(), &one), EvaluationReport::new(&reactive, &other));
    assert!(with.anticipated.fraction > 0.8, "{:?}", with.anticipated);
    assert!(without.anticipated.fraction < 0.3, "{:?}", without.anticipated);
    let [early, late] = [&with, &without].map(|report| report.answer_delay_ms.unwrap().value);
    assert!(early < late, "{early} ms, {late} ms");
    let folder = tempfile::tempdir().unwrap();
    draw_leads(&one, &folder.path().join("leads.svg")).unwrap();
    draw_fluency(&[("with", &with), ("without", &without)], &folder.path().join("fluency.svg")).unwrap();
    let picture = std::fs::read_to_string(folder.path().join("fluency.svg")).unwrap();
    assert!(picture.contains("functional delay"));
}

#[test]
fn a_robot_that_does_not_look_ahead_gets_ready_for_nothing() {
    let myopic = NetworkVariant { reactive: true, myopic: true, ..NetworkVariant::default() };
    let prepared = |network: &NetworkVariant| {
        let (mut trials, span) = (trials("synthetic", network, 2, 2), Occupation::Prepares);
        let spans = trials.drain(..).flat_map(|trial| trial.timeline);
        spans.filter(|own| own.who == Waiting::Robot && own.occupation == span).count()
    };
    assert!(prepared(&NetworkVariant::default()) > 0);
    assert_eq!(prepared(&myopic), 0);
}

/// A person who builds several assemblies one after another is known after ten reaches.
#[test]
fn what_is_understood_of_a_person_after_ten_reaches_is_told_apart() {
    let (settings, network) = (settings("synthetic"), NetworkVariant::default());
    let campaign = Campaign { assemblies: 3, ..campaign(&settings, &network) };
    let trials = run(&campaign, || {}).unwrap();
    let report = EvaluationReport::new(&network, &trials);
    assert_eq!(report.completed.count, 1);
    let known = report.known_people.unwrap();
    let actions = &trials[0].actions;
    let later = actions.iter().filter(|action| action.earlier_reaches >= 10 && action.grasp_ms.is_some());
    assert_eq!(known.right.of, later.count());
    assert!(known.right.of < report.right.of, "{} of {}", known.right.of, report.right.of);
    assert!(actions.is_sorted_by_key(|action| action.earlier_reaches));
    let alone = run(&Campaign { assemblies: 1, ..campaign }, || {}).unwrap();
    assert!(alone[0].actions.iter().all(|action| action.earlier_reaches < 10));
    assert_eq!(EvaluationReport::new(&network, &alone).known_people, None);
    assert_eq!(actions[..alone[0].actions.len() - 1], alone[0].actions[..alone[0].actions.len() - 1]);
}

#[test]
fn without_its_guard_the_robot_is_never_held_back_and_closes_on_people() {
    let (settings, network) = (settings("synthetic"), NetworkVariant::default());
    let reports = [true, false].map(|guarded| {
        let campaign = Campaign { guarded, trials: 2, threads: 2, ..campaign(&settings, &network) };
        EvaluationReport::new(&network, &run(&campaign, || {}).unwrap())
    });
    let [with, without] = &reports;
    assert!(with.held_back > 0.02 && without.held_back < 0.01, "{with:?}, {without:?}");
    assert!(with.robot_closing_ms < 10 && without.robot_closing_ms > 100, "{with:?}, {without:?}");
    let margins = [with, without].map(|report| report.smallest_margin_m.unwrap());
    assert!(margins[1] < margins[0], "{margins:?}");
}

#[test]
fn hidden_actions_have_rows_of_their_own() {
    let trials = trials("random:hidden=0.5,words=0", &NetworkVariant::default(), 3, 2);
    let report = EvaluationReport::new(&NetworkVariant::default(), &trials);
    let valid = |hidden: bool| {
        let actions = trials.iter().flat_map(|trial| &trial.actions).filter(|own| own.hidden == hidden);
        actions.filter(|own| own.error.is_none() && own.grasp_ms.is_some()).count()
    };
    assert!(valid(true) >= 3 && valid(false) >= 3, "{trials:?}");
    assert_eq!((report.right.of, report.anticipated.of), (valid(false), valid(false)));
    let inferred = [report.right_of_hidden, report.wrong_of_hidden, report.absent_of_hidden];
    assert_eq!(inferred.map(|proportion| proportion.of), [valid(true); 3]);
    assert_eq!(inferred.iter().map(|proportion| proportion.count).sum::<usize>(), valid(true));
    assert_eq!(report.false_alarms.of, valid(true) + valid(false));
}

#[test]
fn reaches_in_which_the_mind_was_changed_are_judged_by_the_new_goal() {
    let network = NetworkVariant::default();
    let trials = trials("random:changes=1,hidden=0,words=0,withdraws=0", &network, 3, 2);
    let report = EvaluationReport::new(&network, &trials);
    let actions = || trials.iter().flat_map(|trial| &trial.actions);
    let grasped: Vec<_> = actions().filter(|own| own.turn.is_some() && own.grasp_ms.is_some()).collect();
    let counted = [report.changes_of_mind, report.changes_to_errors]
        .iter()
        .flatten()
        .map(|changes| changes.followed_in_time.of)
        .sum::<usize>();
    assert!(counted >= 5 && counted == grasped.len(), "{counted} counted, {} made", grasped.len());
    for action in grasped {
        let turn = action.turn.as_ref().unwrap();
        assert_ne!((&action.chain, &action.subgoal), (&turn.chain_before, &turn.subgoal_before));
        assert!((action.onset_ms..action.grasp_ms.unwrap()).contains(&turn.turned_ms), "{action:?}");
        // What stands until the grasp, and the verdict at the grasp, are one.
        assert_eq!(turn.followed_ms.is_some(), action.inference == Some(Inference::Right), "{action:?}");
    }
}

#[test]
fn an_ablated_layer_has_no_synapses_and_all_others_stay() {
    let (_, plan) = NetworkPlan::load(&settings("synthetic").task).unwrap();
    let without = |ablation| {
        NetworkVariant { without: vec![ablation], ..NetworkVariant::default() }.apply(plan.clone())
    };
    let quiet = without(Ablation::Eml);
    let row = quiet.layer(LayerKind::ErrorMonitoring).populations.clone();
    assert!(quiet.synapses.iter().all(|own| !row.contains(&own.from) && !row.contains(&own.to)));
    assert!(!quiet.synapses.is_empty() && quiet.synapses.len() < plan.synapses.len());
    let calm = without(Ablation::Noise);
    assert!(calm.layers.iter().all(|layer| layer.noise == 0.0));
    assert_eq!(calm.synapses, plan.synapses);
    assert_eq!(NetworkVariant::default().apply(plan.clone()), plan);
}

#[test]
fn without_common_subgoals_nothing_is_achieved_and_that_is_reported_as_a_deadlock() {
    let network =
        NetworkVariant { without: vec![Ablation::Csgl, Ablation::Oml], ..NetworkVariant::default() };
    let found = trials("random:idle=1,goal=0,request=0,means=0,hidden=0,words=0", &network, 1, 1);
    assert!(found[0].stalled && found[0].completed_ms.is_none(), "{:?}", found[0]);
    assert_eq!(found[0].ended_ms, 60_000);
    assert!(found[0].actions.is_empty());
}

/// In this assembly the robot closed on the hand that it had given a part to, when the handover was over.
#[test]
fn a_robot_that_leaves_a_handover_closes_on_nobody() {
    let (settings, network) = (RunSettings { seed: 51, ..settings("random") }, NetworkVariant::default());
    let trials = run(&campaign(&settings, &network), || {}).unwrap();
    assert!(trials[0].completed_ms.is_some());
    assert_eq!(trials[0].separation.robot_closing_ms, 0, "{:?}", trials[0].separation);
}
