//! The checkpoint of a killed process reaches its replacement.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{FieldFrame, topic};
use coact_period::PERIOD;
use coact_pipeline::Pipeline;
use coact_realtime::{Bus, Candidate, CheckpointStore, Input, Schedule, TopicAnchors, now};
use std::io::Read;
use std::time::Duration;
use support::{TestRun, child_run, ready, spawn};

/// As often as the supervisor polls.
const POLL_INTERVAL: Duration = Duration::from_millis(2);

/// In a process of its own: sends frames, one in each period, until it is killed.
#[test]
#[ignore = "the process to be killed, started by the tests below"]
fn sender() {
    let Some(run) = child_run() else { return };
    ready(&run, "fields", 0);
    let bus = Bus::open(&run, "fields", 0).unwrap();
    let mut output = bus.output::<FieldFrame>(topic::FIELDS).unwrap();
    let schedule = Schedule { start_ns: run.start_ns().unwrap().unwrap() };
    loop {
        let cycle = schedule.tick_at(now());
        let mut frame = output.loan().unwrap();
        frame.activity.fill(cycle as f64);
        frame.send(cycle, 0).unwrap();
        std::thread::sleep(PERIOD);
    }
}

/// In a process of its own: the replacement, which prints what it found.
#[test]
#[ignore = "the replacement, started by the tests below"]
fn replacement() {
    let Some(run) = child_run() else { return };
    let mut process = Candidate::open("fields", run.directory(), 1).unwrap().join().unwrap();
    let mut output = process.bus().output::<FieldFrame>(topic::FIELDS).unwrap();
    match process.checkpoint(&mut output).unwrap() {
        Some(frame) => {
            let whole = frame.activity.iter().all(|&value| value == frame.header.cycle as f64);
            println!("\nfound {} {} {whole}", frame.header.cycle, frame.header.sequence);
            let next = output.loan().unwrap().send(frame.header.cycle + 1, 0).unwrap();
            println!("next {} {}", next.generation, next.sequence);
        }
        None => println!("\nfound nothing"),
    }
}

fn printed_by_replacement(run: &TestRun, store: &mut CheckpointStore) -> String {
    let mut child = spawn("replacement", &run.0);
    while child.try_wait().unwrap().is_none() {
        store.poll().unwrap();
        std::thread::sleep(POLL_INTERVAL);
    }
    let mut printed = String::new();
    child.stdout.take().unwrap().read_to_string(&mut printed).unwrap();
    printed
}

#[test]
fn replacement_resumes_from_the_last_frame_of_the_killed_process() {
    let run = TestRun::started();
    let supervisor = Bus::open(&run.0, "supervisor", 0).unwrap();
    let pipeline = Pipeline::load(&run.0.settings().pipeline).unwrap();
    let anchors = TopicAnchors::new(&supervisor, &pipeline).unwrap();
    assert!(anchors.count() > 10);
    let mut store = CheckpointStore::new(&supervisor).unwrap();
    let mut observed: Input<FieldFrame> = supervisor.input(topic::FIELDS).unwrap();
    let mut sender = spawn("sender", &run.0);
    while observed.header().is_none_or(|header| header.sequence < 30) {
        store.poll().unwrap();
        observed.refresh().unwrap();
        std::thread::sleep(POLL_INTERVAL);
    }
    sender.kill().unwrap();
    sender.wait().unwrap();
    let checkpoint = store.publish("fields").unwrap().unwrap();
    observed.refresh().unwrap();
    assert_eq!(Some(&checkpoint), observed.header(), "the last frame is the checkpoint");
    let printed = printed_by_replacement(&run, &mut store);
    assert!(
        printed.contains(&format!("found {} {} true", checkpoint.cycle, checkpoint.sequence)),
        "{printed}"
    );
    assert!(printed.contains(&format!("next 1 {}", checkpoint.sequence + 1)), "{printed}");
    assert_eq!(supervisor.clean_dead(), 1, "one node died");
    assert_eq!(supervisor.clean_dead(), 0, "and was cleaned up");
}

#[test]
fn replacement_is_told_at_once_that_there_is_no_checkpoint() {
    let run = TestRun::started();
    let supervisor = Bus::open(&run.0, "supervisor", 0).unwrap();
    let pipeline = Pipeline::load(&run.0.settings().pipeline).unwrap();
    let _anchors = TopicAnchors::new(&supervisor, &pipeline).unwrap();
    let mut store = CheckpointStore::new(&supervisor).unwrap();
    assert_eq!(store.publish("fields").unwrap(), None);
    assert!(printed_by_replacement(&run, &mut store).contains("found nothing"));
    assert_eq!(store.publish("voice").unwrap(), None, "a process without state");
}
