//! A whole report from hand-made messages: events, restart, summary, verdict, pictures.
#![allow(clippy::unwrap_used)]

use crate::support::schema::misfit;
use crate::support::*;
use coact_messages::{LayerKind, Pulse, SensorSample, Speech};
use coact_monitor::{Monitor, PipelineNode, Rules, Watched};
use coact_run_records::{
    Environment, Event, Judgement, MachineReport, Record, RunLog, Snapshot, Summary, SupervisorEvent, Verdict,
};
use serde_json::Value;
use std::path::Path;
use std::time::{Duration, SystemTime};

fn rules() -> Rules {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/verdict.toml");
    Rules::load(Path::new(path)).unwrap()
}

fn watched(report: &Path) -> Watched {
    let nodes =
        vec![PipelineNode { process: "control".into(), input_from: Some("fields".into()), last: true }];
    let (task, intentions) = (task(), intentions());
    let started = SystemTime::now();
    let report = report.to_owned();
    let (limits, fresh) = (arm_limits(), Duration::from_millis(50));
    let separation = separation_meter();
    Watched {
        report,
        task,
        intentions,
        nodes,
        limits,
        separation,
        fresh,
        rules: rules(),
        start_ns: 0,
        started,
    }
}

fn open(report: &Path) -> Monitor {
    Monitor::open(watched(report)).unwrap()
}

fn speech(cycle: u64, text: &str) -> Speech {
    let mut speech: Speech = bytemuck::Zeroable::zeroed();
    speech.header.cycle = cycle;
    speech.length = text.len() as u64;
    speech.text[..text.len()].copy_from_slice(text.as_bytes());
    speech
}

/// Two subgoals, one action with the right decision, one sentence: cycles of a complete assembly.
fn play(monitor: &mut Monitor, cycles: std::ops::Range<u64>) {
    let mut events = Vec::new();
    for cycle in cycles {
        let mut truth = acting(cycle, 1, MOUNT, LID, 100, if cycle >= 800 { 800 } else { 0 });
        truth.achieved = u64::from(cycle >= 900) | u64::from(cycle >= 1200) << 1;
        monitor.truth(&truth, &mut events);
        let mut frame = if cycle >= 600 { decided(cycle, STEADY_LID, 600) } else { frame(cycle) };
        let memory = frame.populations(LayerKind::SubgoalsAchieved).start;
        frame.since[memory] = if cycle >= 950 { 950 } else { 0 };
        monitor.frame(&frame, &mut events);
        monitor.pulse("control", &pulse(cycle, 20_000));
        if cycle == 650 {
            monitor.speech(&speech(cycle, "I will hold it."), &mut events);
        }
        monitor.record(pulse(cycle, 0).released_ns, std::mem::take(&mut events)).unwrap();
    }
}

fn finish(monitor: Monitor) -> Summary {
    let environment = Environment {
        kernel: "Linux 6.1".into(),
        preemption: "PREEMPT_DYNAMIC".into(),
        governor: "none".into(),
        cores: 2,
        memory_locked: true,
        schedulers: [("control".into(), "SCHED_FIFO 80 on core 1".into())].into(),
        machine: Some(MachineReport { wakeups: 2000, late: 3, p999_ns: 80_000, longest_ns: 4_500_000 }),
    };
    monitor.finish(environment, 2_000_000_000).unwrap()
}

const INJECTED: &str =
    r#"{"at_ns":700000000,"event":"injected","process":"control","generation":0,"pid":7,"fault":"slow"}"#;

#[test]
fn summary_has_the_documented_keys_and_metrics() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(SupervisorEvent::FILE), format!("{INJECTED}\n")).unwrap();
    let mut monitor = open(folder.path());
    play(&mut monitor, 0..2000);
    finish(monitor);
    insta::assert_snapshot!(std::fs::read_to_string(folder.path().join(Summary::FILE)).unwrap());
}

/// The lines of a log, or the one value of another file, fit the schema that is published for them.
fn assert_published(report: &Path, file: &str) {
    let (name, _) = file.split_once('.').unwrap();
    let schema = format!("{}/../../docs/schemas/{name}.schema.json", env!("CARGO_MANIFEST_DIR"));
    let schema: Value = serde_json::from_str(&std::fs::read_to_string(schema).unwrap()).unwrap();
    let text = std::fs::read_to_string(report.join(file)).unwrap();
    let values: Vec<Value> =
        serde_json::Deserializer::from_str(&text).into_iter().map(Result::unwrap).collect();
    assert!(!values.is_empty(), "{file} is empty");
    for value in &values {
        assert_eq!(misfit(value, &schema, &schema), None, "{file}: {value}");
    }
    let mut spoilt = values[0].clone();
    spoilt["at_noon"] = true.into();
    assert!(misfit(&spoilt, &schema, &schema).is_some(), "the schema of {file} allows anything");
}

#[test]
fn what_a_run_leaves_fits_the_published_schemas() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(SupervisorEvent::FILE), format!("{INJECTED}\n")).unwrap();
    let mut monitor = open(folder.path());
    let sample: Box<SensorSample> = bytemuck::zeroed_box();
    monitor.sample(&sample);
    play(&mut monitor, 0..2000);
    finish(monitor);
    for file in [Summary::FILE, Event::FILE, SupervisorEvent::FILE, Snapshot::FILE] {
        assert_published(folder.path(), file);
    }
}

#[test]
fn pictures_are_drawn_for_every_histogram_and_the_anticipation() {
    let folder = tempfile::tempdir().unwrap();
    let mut monitor = open(folder.path());
    play(&mut monitor, 0..2000);
    finish(monitor);
    for name in ["wakeup.control", "execution.control", "hop.fields.control", "end-to-end", "anticipation"] {
        let picture = std::fs::read_to_string(folder.path().join(format!("plots/{name}.svg"))).unwrap();
        assert!(picture.trim_end().ends_with("</svg>"), "{name}");
        assert!(picture.contains("percentile") || picture.contains("mount: lid"), "{name}");
    }
}

#[test]
fn a_killed_monitor_goes_on_and_tells_the_same_story() {
    let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut monitor = open(whole.path());
    play(&mut monitor, 0..2000);
    let expected = finish(monitor);

    for (start, kill) in [(0, 700), (700, 1000), (1000, 1300)] {
        let mut monitor = open(parts.path());
        play(&mut monitor, start..kill);
        monitor.write().unwrap();
        let mut events = Vec::new();
        monitor.speech(&speech(650, "I will hold it."), &mut events);
        assert_eq!(events.is_empty(), kill >= 650, "a sentence is told once");
    }
    let mut monitor = open(parts.path());
    play(&mut monitor, 1300..2000);
    let found = finish(monitor);
    assert_eq!(found.task, expected.task);
    assert_eq!(found.anticipation, expected.anticipation);
    assert_eq!(found.processes, expected.processes);
    assert_eq!((found.work, found.timing), (Judgement::default(), Judgement::default()));
}

#[test]
fn an_achieved_subgoal_that_the_fields_lose_fails_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut monitor = open(folder.path());
    play(&mut monitor, 0..1100);
    let mut events = Vec::new();
    let mut truth = acting(1100, 1, MOUNT, LID, 100, 800);
    truth.achieved = 1;
    monitor.truth(&truth, &mut events);
    monitor.frame(&frame(1100), &mut events); // no peak for the achieved subgoal any more
    assert_eq!(events, [Event::Forgotten { at_ms: 1100, name: "lid".into() }]);
    monitor.record(1, events).unwrap();
    let summary = finish(monitor);
    assert_eq!(summary.work.verdict, Verdict::Fail);
    assert_eq!(summary.work.reasons, ["at 1.1 s the fields lost the achieved subgoal \"lid\""]);
}

/// Cycle of a process that publishes a period late in every second cycle.
fn halting(cycle: u64) -> Pulse {
    let mut halting = pulse(cycle, if cycle % 2 == 1 { 1_000_000 } else { 0 });
    halting.missed = cycle.div_ceil(2);
    halting
}

#[test]
fn each_rule_that_is_broken_is_one_reason() {
    let folder = tempfile::tempdir().unwrap();
    let supervisor = INJECTED.replace("injected", "died").replace("slow", "kill");
    let given_up = supervisor.replace("died", "gave_up");
    std::fs::write(folder.path().join(SupervisorEvent::FILE), format!("{supervisor}\n{given_up}\n")).unwrap();
    let mut monitor = open(folder.path());
    let mut events = Vec::new();
    for cycle in 0..1000 {
        // The wrong action is decided on, half of the deadlines are missed, and the arm moves too fast.
        monitor.truth(&acting(cycle, 1, MOUNT, LID, 100, if cycle >= 800 { 800 } else { 0 }), &mut events);
        let frame = if cycle >= 600 { decided(cycle, RECEIVE_HINGE, 600) } else { frame(cycle) };
        monitor.frame(&frame, &mut events);
        monitor.pulse("control", &halting(cycle));
        monitor.sample(&moving(cycle, 2.5));
    }
    // Then nothing was seen for three seconds, while the arm moved on without a command.
    let mut later = halting(4000);
    later.header.sensor_ns = halting(999).header.sensor_ns;
    monitor.pulse("control", &later);
    (4001..4100).for_each(|cycle| monitor.sample(&moving(cycle, 2.5)));
    monitor.record(1, events).unwrap();
    let summary = monitor.finish(Environment::default(), 200_000_000_000).unwrap();
    let sentences = [summary.work.reasons.join("\n"), summary.timing.reasons.join("\n")];
    insta::assert_snapshot!(sentences.join("\n-- timing\n"));
}

#[test]
fn outputs_may_be_missing_as_often_as_the_machine_itself_was_late() {
    let machine =
        |late| Some(MachineReport { wakeups: 1000, late, p999_ns: 5_000_000, longest_ns: 5_000_000 });
    for (late, passes) in [(500, true), (430, false)] {
        let folder = tempfile::tempdir().unwrap();
        let mut monitor = open(folder.path());
        (0..1000).for_each(|cycle| monitor.pulse("control", &halting(cycle)));
        let environment = Environment { machine: machine(late), ..Environment::default() };
        let summary = monitor.finish(environment, 1_000_000_000).unwrap();
        assert_eq!(summary.timing.passes(), passes, "{late} late wake-ups: {:?}", summary.timing);
        assert!(summary.work.passes(), "what the machine is late by spoils no work: {:?}", summary.work);
    }
}

#[test]
fn what_is_due_ends_when_a_process_was_requested_to_end() {
    let stop = INJECTED.replace("injected", "stop_requested").replace("700000000", "1000000000");
    for (log, missing) in [(String::new(), 1000), (format!("{stop}\n"), 0)] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(SupervisorEvent::FILE), log).unwrap();
        let mut monitor = open(folder.path());
        (0..1000).for_each(|cycle| monitor.pulse("control", &pulse(cycle, 0)));
        let summary = monitor.finish(Environment::default(), 2_000_000_000).unwrap();
        assert_eq!(summary.processes["control"].outage.without_output, missing);
        assert_eq!(summary.command_outage.longest, missing);
        assert_eq!(summary.timing.passes(), missing == 0, "{:?}", summary.timing);
    }
}

#[test]
fn a_process_that_never_published_was_missing_all_the_time() {
    let folder = tempfile::tempdir().unwrap();
    let summary = open(folder.path()).finish(Environment::default(), 5_000_000_000).unwrap();
    assert_eq!(summary.processes["control"].outage.without_output, 5000);
    assert!(!summary.timing.passes());
}

#[test]
fn a_monitor_that_stood_still_says_from_when_to_when_and_fails_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut monitor = open(folder.path());
    (0..1000).for_each(|cycle| monitor.pulse("control", &pulse(cycle, 0)));
    monitor.record(1, Vec::new()).unwrap();
    // Its buffers hold the last half second of the 15 in which it did not look.
    (15_488..16_000).for_each(|cycle| monitor.pulse("control", &pulse(cycle, 0)));
    monitor.record(1, Vec::new()).unwrap();
    let summary = monitor.finish(Environment::default(), 16_000_000_000).unwrap();
    let events = RunLog::<Event>::read(folder.path()).unwrap();
    assert!(events.contains(&Event::Blind { from_ms: 1000, until_ms: 15_488 }), "{events:?}");
    assert_eq!((summary.blind_s, summary.processes["control"].unseen), (14.488, 14_488));
    assert!(!summary.work.passes() && summary.timing.passes(), "{:?} {:?}", summary.work, summary.timing);
}

#[test]
fn frames_of_another_task_are_not_judged() {
    let folder = tempfile::tempdir().unwrap();
    let mut monitor = open(folder.path());
    let mut foreign = decided(1, STEADY_LID, 1);
    foreign.task = 43;
    let mut events = Vec::new();
    monitor.frame(&foreign, &mut events);
    assert_eq!(events, []);
}

#[test]
fn a_foreign_event_log_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(Event::FILE), "{\"event\":\"dance\"}\n").unwrap();
    let error = Monitor::open(watched(folder.path())).unwrap_err().to_string();
    assert!(error.contains("events.jsonl:1: not a line of this log"), "{error}");
}

#[test]
fn a_damaged_supervisor_log_is_named_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(SupervisorEvent::FILE), format!("{INJECTED}\n{{}}\n")).unwrap();
    let error = open(folder.path()).record(1, Vec::new()).unwrap_err().to_string();
    assert!(error.contains("supervisor.jsonl:2: not a line of this log: missing field"), "{error}");
}

#[test]
fn an_earlier_runs_report_is_cleared_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(SupervisorEvent::FILE), "").unwrap();
    let mut monitor = open(folder.path());
    play(&mut monitor, 0..2000);
    finish(monitor);
    Monitor::clear(folder.path()).unwrap();
    let mut left = Vec::new();
    for entry in [folder.path().into(), folder.path().join("latency"), folder.path().join("plots")] {
        let entries = std::fs::read_dir(entry).unwrap();
        left.extend(entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()));
    }
    left.sort();
    assert_eq!(left, ["latency", "plots", "supervisor.jsonl"]);
}
