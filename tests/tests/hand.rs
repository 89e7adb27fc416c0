//! A program outside a running set moves the partner's hand; when it dies, the hand is not seen any more.
#![allow(clippy::unwrap_used)]

use coact_messages::{HandPoints, KeypointName, Percept, SensorSample, topic};
use coact_pipeline::Run;
use coact_realtime::{Bus, Input, Output, now};
use coact_tests::{Launched, coact, wait_within};
use std::io::Write;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// From one hand to the next: 60 Hz.
const FRAME: Duration = Duration::from_millis(16);
/// Within so long whatever is waited for happens, on a busy machine too.
const SOON: Duration = Duration::from_secs(20);
/// How long after its last frame perception gives a hand up.
const GIVEN_UP: Duration = Duration::from_millis(150);
/// Two frames of the tracker, and as late as a busy machine may be.
const LATE: Duration = Duration::from_millis(34 + 200);
/// A hand over the table, where no part lies: x, y, z, m; pitch, degrees; aperture, m.
const HAND: [f64; 5] = [-1.05, -0.05, 0.95, -40.0, 0.05];

/// `coact hand` of a run, whose lines a test writes.
fn bridge(run: &Run) -> Child {
    let mut command = Command::new(coact());
    command
        .args(["hand", "--run", run.id()])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// Tells where the hand is, until `until` says so.
fn tell_until(child: &mut Child, mut until: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !until() {
        assert!(begin.elapsed() < SOON, "it does not come");
        writeln!(child.stdin.as_mut().unwrap(), "{HAND:?}").unwrap();
        std::thread::sleep(FRAME);
    }
}

/// Sends what is no hand, and more hands than anybody tells.
fn spoof(run: &Run) {
    let bus = Bus::open(run, "test", 0).unwrap();
    let mut output: Output<HandPoints> = bus.output(topic::HAND).unwrap();
    let schedule = coact_realtime::Schedule { start_ns: run.start_ns().unwrap().unwrap() };
    for turn in 0..2_000 {
        let mut message = output.loan().unwrap();
        message.position = if turn % 2 == 0 { [[f64::NAN; 3]; 9] } else { ARM };
        message.send(schedule.tick_at(now()), now()).unwrap();
        // Twice as fast as it must be: a busy machine sleeps longer than it is told to.
        std::thread::sleep(Duration::from_micros(200));
    }
}

/// An arm that reaches over a table.
const ARM: [[f64; 3]; 9] = [
    [-1.28, 0.12, 1.18],
    [-1.15, 0.05, 0.92],
    [-0.95, 0.14, 1.00],
    [-0.93, 0.16, 0.99],
    [-0.88, 0.18, 0.90],
    [-0.88, 0.16, 0.94],
    [-0.88, 0.10, 0.90],
    [-0.87, 0.09, 0.89],
    [-0.88, 0.10, 0.94],
];

#[test]
fn a_hand_from_outside_is_seen_while_it_is_told_and_its_teller_may_die() {
    let mut launched = Launched::start(&["--duration", "30", "--world", "kinematic", "--partner", "hand"]);
    let run = launched.when_started();
    let bus = Bus::open(&run, "viewer", 0).unwrap();
    let mut percepts: Input<Percept> = bus.input(topic::PERCEPT).unwrap();
    let mut samples: Input<SensorSample> = bus.input(topic::SENSORS).unwrap();
    let mut child = bridge(&run);
    tell_until(&mut child, || {
        percepts.refresh().unwrap();
        percepts.latest().is_some_and(|percept| percept.arms[0].is_tracked())
    });
    let told = Instant::now();
    tell_until(&mut child, || told.elapsed() > Duration::from_secs(2));
    samples.refresh().unwrap();
    let keypoints = samples.latest().unwrap().hands[0].keypoints;
    let (thumb, index) =
        (keypoints[KeypointName::ThumbTip as usize], keypoints[KeypointName::IndexTip as usize]);
    for ((thumb, index), told) in thumb.position.iter().zip(index.position).zip(HAND) {
        let middle = 0.5 * (thumb + index);
        assert!((middle - told).abs() < 0.02, "{middle} m instead of {told}");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let killed = Instant::now();
    let limit = HandPoints::LIFETIME + GIVEN_UP + LATE;
    wait_within(SOON, "a hand that is not seen", || {
        percepts.refresh().unwrap();
        (!percepts.latest().unwrap().arms[0].is_tracked()).then_some(())
    });
    let unseen = killed.elapsed();
    println!("not seen {} ms after its teller was killed", unseen.as_millis());
    assert!(unseen < limit, "not seen after {unseen:?}, expected {limit:?}");
    // The next one finds the topic as if nothing had been.
    let mut child = bridge(&run);
    tell_until(&mut child, || {
        percepts.refresh().unwrap();
        percepts.latest().unwrap().arms[0].is_tracked()
    });
    drop(child.stdin.take());
    assert!(child.wait().unwrap().success(), "the lines' end is no error");
    spoof(&run);
    drop((percepts, samples, bus));
    let finished = launched.finish();
    finished.nobody_died();
    let refused = &finished.summary().refused["world"];
    assert!(refused["implausible"] > 100 && refused["too often"] > 100, "{refused:?}");
}

#[test]
fn what_is_no_hand_and_a_set_with_another_partner_are_refused_with_what_was_expected() {
    let mut launched = Launched::start(&["--duration", "20", "--world", "kinematic", "--partner", "hand"]);
    let run = launched.when_started();
    let cases =
        [("[1, 2]", "line 1: 2 numbers"), ("[9, 0, 1, 0, 0.1]", "line 1: position"), ("x", "line 1: ")];
    for (line, expected) in cases {
        let mut child = bridge(&run);
        writeln!(child.stdin.take().unwrap(), "{line}").unwrap();
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(expected) && said.contains("expected "), "{said}");
    }
    drop(launched);
    let mut launched = Launched::start(&["--duration", "5", "--world", "kinematic"]);
    let run = launched.when_started();
    let output = bridge(&run).wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("coact launch --partner hand"), "{said}");
}
