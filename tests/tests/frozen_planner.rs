//! A planner that stands still is noticed and replaced, with the process that it belongs to.
#![allow(clippy::unwrap_used)]

use coact_messages::{ARM_JOINTS, SensorSample, topic};
use coact_realtime::{Bus, Input};
use coact_run_records::{SupervisorEvent, SupervisorEventKind};
use coact_tests::{Launched, coact, wait_for};
use rustix::process::Signal;
use std::process::Command;

/// A joint of the arm this fast moves in earnest, rad/s.
const FAST: f64 = 0.4;

fn inject(process: &str, run: &str) -> (Option<i32>, String) {
    let arguments = ["inject", process, "freeze-planner", "--run", run];
    let output = Command::new(coact()).args(arguments).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// Waits until the arm moves, from now on.
fn wait_for_a_fast_arm(samples: &mut Input<SensorSample>) {
    samples.refresh().unwrap();
    wait_for("a fast arm", || {
        let mut is_fast = false;
        let speeds = |sample: &SensorSample| sample.drive.velocity[..ARM_JOINTS].to_vec();
        samples.each(|sample| is_fast |= speeds(sample).iter().any(|speed| speed.abs() > FAST)).unwrap();
        is_fast.then_some(())
    });
}

#[test]
fn a_frozen_planner_is_replaced_and_the_arm_moves_afterwards() {
    let mut launched = Launched::start(&["--duration", "100", "--world", "kinematic"]);
    let run = launched.when_started();
    let bus = Bus::open(&run, "viewer", 0).unwrap();
    let mut samples = bus.input(topic::SENSORS).unwrap();
    wait_for_a_fast_arm(&mut samples);
    let (code, said) = inject("fields", run.id());
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("freeze-planner cannot be done to fields; expected control"), "{said}");
    let (code, said) = inject("control", run.id());
    assert_eq!(code, Some(0), "{said}");
    let replacement = wait_for("the replacement of control", || run.ready("control", 1).unwrap());
    assert!(replacement.resumed, "what control knew is lost");
    wait_for_a_fast_arm(&mut samples);
    launched.signal(Signal::TERM);
    let finished = launched.finish();
    finished.only_died(&["control"]);
    let died =
        |event: &&SupervisorEvent| event.event == SupervisorEventKind::Died && event.process == "control";
    let death = finished.supervisor.iter().find(died).unwrap();
    assert_eq!(death.fault.as_deref(), Some("freeze-planner"));
    assert_eq!(death.reason.as_deref(), Some("ended by itself, because a thread of it hung"));
    assert!(finished.stderr.contains("the thread \"planner\" hangs"), "{}", finished.stderr);
    let of_control = finished.summary().faults.iter().filter(|fault| fault.process == "control");
    let [fault] = of_control.collect::<Vec<_>>()[..] else { panic!("{:?}", finished.summary().faults) };
    assert!(fault.detected_ms.is_some() && fault.recovered_ms.is_some(), "{fault:?}");
}
