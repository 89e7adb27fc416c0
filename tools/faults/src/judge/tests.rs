#![allow(clippy::unwrap_used)]
use super::*;
use crate::evidence::Ending;
use crate::{MessageFault, Trouble};
use coact_run_records::{FaultReport, Judgement, Summary, SupervisorEvent, TaskReport};
use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::ExitStatus;

const S: u64 = 1_000_000_000;
/// The run begins at 100 s of the machine's clock; the cell lasts from its 10th to its 13th second.
const START: u64 = 100 * S;

fn rules() -> Rules {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    Rules::load(&folder.join(Rules::FILE)).unwrap()
}

fn seen() -> MotionReport {
    MotionReport { samples: 3000, speed: 0.8, acceleration: 0.9, ..MotionReport::default() }
}

fn record(fault: FaultKind, target: Target) -> Record {
    Record {
        cell: Cell { fault, target, moment: Moment::Moving },
        from_ns: START + 10 * S,
        until_ns: START + 13 * S,
        resumed: BTreeMap::from([("fields", true)]),
        motion: seen(),
        trouble: None,
    }
}

fn kill() -> Record {
    record(FaultKind::Process(coact_supervisor::Fault::Kill), Target::Process("fields"))
}

fn noted(event: SupervisorEventKind, process: &str, reason: &str) -> SupervisorEvent {
    SupervisorEvent {
        at_ns: START + 10 * S + 1,
        event,
        process: process.into(),
        generation: 0,
        pid: 7,
        fault: None,
        reason: Some(reason.into()),
        user: None,
    }
}

/// Of a run that came over a kill of fields as it should.
fn evidence() -> Evidence {
    let task = TaskReport::new(|_| 7, &[], 20.0);
    let mut summary = Summary::unmeasured(task, String::new());
    summary.work = Judgement::default();
    summary.motion = seen();
    summary.faults.push(FaultReport {
        process: "fields".into(),
        fault: "kill".into(),
        at_s: 10.0,
        detected_ms: Some(1.0),
        recovered_ms: Some(15.0),
        survivors_missed: 0,
        survivors_missed_by: BTreeMap::new(),
        machine_late_ms: 0.0,
    });
    Evidence {
        ending: Ending { status: Some(ExitStatus::from_raw(0)), left_behind: Vec::new() },
        summary: Some(summary),
        events: vec![Event::Subgoal { at_ms: 15_000, assembly: 0, subgoal: 1, name: "wheel".into() }],
        supervisor: vec![
            noted(SupervisorEventKind::Injected, "fields", ""),
            noted(SupervisorEventKind::Died, "fields", "killed by SIGKILL"),
        ],
        start_ns: Some(START),
        last_speed: 0.0,
    }
}

fn changed(change: impl FnOnce(&mut Evidence)) -> Evidence {
    let mut evidence = evidence();
    change(&mut evidence);
    evidence
}

fn red(record: &Record, evidence: &Evidence) -> String {
    match judge(record, evidence, &rules(), true) {
        Outcome::Red(reasons) => reasons.join("; "),
        other => panic!("{other:?}"),
    }
}

fn late(record: &Record, evidence: &Evidence) -> String {
    match judge(record, evidence, &rules(), true) {
        Outcome::Late(reasons) => reasons.join("; "),
        other => panic!("{other:?}"),
    }
}

fn unknown(record: &Record, evidence: &Evidence, alone: bool) -> String {
    match judge(record, evidence, &rules(), alone) {
        Outcome::Unknown(why) => why,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_set_that_came_over_a_kill_is_green() {
    assert_eq!(judge(&kill(), &evidence(), &rules(), true), Outcome::Green);
}

#[test]
fn each_rule_that_is_broken_is_a_reason() {
    let summary =
        |evidence: &mut Evidence, change: fn(&mut Summary)| evidence.summary.iter_mut().for_each(change);
    let cases: [(Evidence, &str); 9] = [
        (
            changed(|it| summary(it, |it| it.motion.acceleration = 1.2)),
            "acceleration of joint 0 over its limit at 0.00 s: 1.200",
        ),
        (changed(|it| summary(it, |it| it.motion.on_stale_data_ms = 400)), "stale data, ms: 400"),
        (changed(|it| summary(it, |it| it.faults.clear())), "the summary has no fault of fields"),
        (changed(|it| summary(it, |it| it.faults[0].recovered_ms = None)), "fields did not recover"),
        (changed(|it| it.ending.left_behind.push("coact_1_x".into())), "left behind: coact_1_x"),
        (changed(|it| it.ending.status = Some(ExitStatus::from_raw(9))), "expected exit status 0"),
        (changed(|it| it.supervisor.push(noted(SupervisorEventKind::Died, "world", "?"))), "world died: ?"),
        (changed(|it| it.events.clear()), "no subgoal was achieved afterwards"),
        (
            changed(|it| it.events.push(Event::Forgotten { at_ms: 11_000, name: "nut".into() })),
            "the fields lost the achieved subgoal \"nut\"",
        ),
    ];
    for (evidence, reason) in cases {
        let found = red(&kill(), &evidence);
        assert!(found.contains(reason), "{found}, expected {reason}");
    }
}

#[test]
fn what_the_viewer_saw_counts_though_the_monitor_saw_nothing_of_it() {
    let fast = Record { motion: MotionReport { speed: 1.3, ..seen() }, ..kill() };
    assert!(red(&fast, &evidence()).contains("speed of joint 0 over its limit at 0.00 s: 1.300"));
}

#[test]
fn survivors_may_miss_no_more_than_the_rules_allow() {
    let missed = |cycles| {
        changed(|it| {
            it.summary.as_mut().unwrap().faults[0].survivors_missed_by.insert("control".into(), cycles);
        })
    };
    assert!(late(&kill(), &missed(101)).contains("control missed 101 cycles"));
    assert_eq!(judge(&kill(), &missed(100), &rules(), true), Outcome::Green);
}

#[test]
fn a_replacement_without_its_checkpoint_has_lost_something() {
    let anew = Record { resumed: BTreeMap::from([("fields", false)]), ..kill() };
    assert!(red(&anew, &evidence()).contains("the replacement of fields has no checkpoint"));
}

#[test]
fn what_cannot_be_judged_is_unknown() {
    let trouble = Record { trouble: Some(Trouble("the moment did not come".into())), ..kill() };
    assert_eq!(unknown(&trouble, &evidence(), true), "the moment did not come");
    let blind = Record { motion: MotionReport::default(), ..kill() };
    let unseen = changed(|it| it.summary.as_mut().unwrap().motion.unseen = 5000);
    assert!(unknown(&blind, &unseen, true).contains("saw the joints"));
    let not_injected = changed(|it| _ = it.supervisor.remove(0));
    assert!(unknown(&kill(), &not_injected, true).contains("no injection"));
    // Of several cells in a run, nobody knows which one left it behind.
    let left = changed(|it| it.ending.left_behind.push("coact_1_x".into()));
    assert!(unknown(&kill(), &left, false).contains("one of several cells: left behind"));
}

#[test]
fn while_the_world_is_replaced_nobody_needs_to_see_the_joints() {
    let motion = MotionReport { unseen: 1100, ..seen() };
    let world = Record {
        cell: Cell { target: Target::Process("world"), ..kill().cell },
        resumed: BTreeMap::from([("world", true)]),
        motion,
        ..kill()
    };
    let replaced_after = |ms| {
        changed(|it| {
            let summary = it.summary.as_mut().unwrap();
            (summary.motion, summary.faults[0].process) = (motion, "world".into());
            summary.faults[0].recovered_ms = Some(ms);
            it.supervisor.iter_mut().for_each(|event| event.process = "world".into());
        })
    };
    assert_eq!(judge(&world, &replaced_after(650.0), &rules(), true), Outcome::Green);
    assert!(unknown(&world, &replaced_after(550.0), true).contains("saw the joints"));
}

#[test]
fn a_message_that_nobody_refused_was_accepted() {
    let future = record(FaultKind::Message(MessageFault::Future), Target::Process("fields"));
    let mut evidence = changed(|it| it.supervisor.clear());
    let reason = red(&future, &evidence);
    assert!(reason.contains("control ignored no message as \"from the future\""), "{reason}");
    for reader in ["fields", "control", "monitor"] {
        let counts = BTreeMap::from([("from the future".to_owned(), 12)]);
        evidence.summary.as_mut().unwrap().refused.insert(reader.into(), counts);
    }
    assert_eq!(judge(&future, &evidence, &rules(), true), Outcome::Green);
}

#[test]
fn the_arm_stands_when_the_last_sample_of_a_dead_set_comes() {
    let fault = FaultKind::Process(coact_supervisor::Fault::Kill);
    let killed = record(fault, Target::Supervisor);
    let ending = |speed| {
        changed(|it| {
            it.summary = None;
            it.supervisor.clear();
            it.ending.status = Some(ExitStatus::from_raw(9));
            it.last_speed = speed;
        })
    };
    assert_eq!(judge(&killed, &ending(0.0), &rules(), true), Outcome::Green);
    assert!(red(&killed, &ending(0.7)).contains("still moved at 0.70 rad/s"));
    // However it ends, unless who drives the joints is dead then.
    let moving = changed(|it| it.last_speed = 0.7);
    let at_shutdown = |process| {
        let mut record = record(fault, Target::Process(process));
        record.cell.moment = Moment::Shutdown;
        record
    };
    assert!(red(&record(fault, Target::Process("fields")), &moving).contains("still moved"));
    assert!(red(&at_shutdown("fields"), &moving).contains("still moved"));
    let without_deaths = Evidence { supervisor: Vec::new(), ..moving };
    assert_eq!(judge(&at_shutdown("world"), &without_deaths, &rules(), true), Outcome::Green);
}

#[test]
fn who_dies_of_an_earlier_cells_latent_fault_is_no_bystander() {
    let starved = |generation| {
        changed(|it| {
            let early = SupervisorEvent {
                at_ns: START + 5 * S,
                generation,
                ..noted(SupervisorEventKind::InjectedLatent, "world", "")
            };
            it.supervisor.extend([early, noted(SupervisorEventKind::Died, "world", "no handles")]);
        })
    };
    assert_eq!(judge(&kill(), &starved(0), &rules(), true), Outcome::Green);
    assert!(red(&kill(), &starved(1)).contains("world died"), "another generation was starved");
}
