//! What a killed process had sent survives in the keeper's hands and reaches its replacement.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{FieldFrame, topic};
use coact_pipeline::Pipeline;
use coact_realtime::{Bus, Input, Keeper, Process};
use std::io::Read;
use std::time::Duration;
use support::{TABLE, TestRun, child_run, spawn};

const FEW: Duration = Duration::from_millis(2);

/// In a process of its own: sends frames, one for each millisecond, until it is killed.
#[test]
#[ignore = "the process to be killed, started by the tests below"]
fn sender() {
    let Some(run) = child_run() else { return };
    let bus = Bus::open(&run, "fields", 0).unwrap();
    let mut output = bus.output::<FieldFrame>(topic::FIELDS).unwrap();
    for cycle in 1.. {
        let mut frame = output.loan().unwrap();
        frame.activity.fill(cycle as f64);
        frame.send(cycle, 0).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// In a process of its own: the replacement, which says what it found.
#[test]
#[ignore = "the replacement, started by the tests below"]
fn replacement() {
    let Some(run) = child_run() else { return };
    let mut process = Process::open("fields", run.directory(), 1).unwrap();
    let mut output = process.bus().output::<FieldFrame>(topic::FIELDS).unwrap();
    match process.survivor(&mut output).unwrap() {
        Some(frame) => {
            let whole = frame.activity.iter().all(|&value| value == frame.header.cycle as f64);
            println!("\nfound {} {} {whole}", frame.header.cycle, frame.header.sequence);
            let next = output.loan().unwrap().send(frame.header.cycle + 1, 0).unwrap();
            println!("next {} {}", next.generation, next.sequence);
        }
        None => println!("\nfound nothing"),
    }
}

fn said_by_replacement(run: &TestRun, keeper: &mut Keeper) -> String {
    let mut child = spawn("replacement", &run.0);
    while child.try_wait().unwrap().is_none() {
        keeper.poll().unwrap();
        std::thread::sleep(FEW);
    }
    let mut said = String::new();
    child.stdout.take().unwrap().read_to_string(&mut said).unwrap();
    said
}

#[test]
fn replacement_goes_on_from_the_last_frame_of_the_killed_process() {
    let run = TestRun::new(TABLE);
    let supervisor = Bus::open(&run.0, "supervisor", 0).unwrap();
    let pipeline = Pipeline::load(&run.0.settings().pipeline).unwrap();
    let held = supervisor.hold_all(&pipeline).unwrap();
    assert!(held.count() > 10);
    let mut keeper = Keeper::new(&supervisor).unwrap();
    let mut witness: Input<FieldFrame> = supervisor.input(topic::FIELDS).unwrap();
    let mut sender = spawn("sender", &run.0);
    while witness.header().is_none_or(|header| header.cycle < 30) {
        keeper.poll().unwrap();
        witness.refresh().unwrap();
        std::thread::sleep(FEW);
    }
    sender.kill().unwrap();
    sender.wait().unwrap();
    let offered = keeper.offer("fields").unwrap().unwrap();
    witness.refresh().unwrap();
    assert_eq!(Some(&offered), witness.header(), "the very last frame is offered");
    let said = said_by_replacement(&run, &mut keeper);
    assert!(said.contains(&format!("found {} {} true", offered.cycle, offered.sequence)), "{said}");
    assert!(said.contains(&format!("next 1 {}", offered.sequence + 1)), "{said}");
    assert_eq!(supervisor.clean_dead(), 1, "one node died");
    assert_eq!(supervisor.clean_dead(), 0, "and was cleaned up");
}

#[test]
fn replacement_is_told_at_once_that_nothing_survived() {
    let run = TestRun::new(TABLE);
    let supervisor = Bus::open(&run.0, "supervisor", 0).unwrap();
    let pipeline = Pipeline::load(&run.0.settings().pipeline).unwrap();
    let _held = supervisor.hold_all(&pipeline).unwrap();
    let mut keeper = Keeper::new(&supervisor).unwrap();
    assert_eq!(keeper.offer("fields").unwrap(), None);
    assert!(said_by_replacement(&run, &mut keeper).contains("found nothing"));
    assert_eq!(keeper.offer("voice").unwrap(), None, "a process without memory");
}
