//! The snapshot log of a run, from hand-made messages: when a snapshot is taken, and what it tells.
#![allow(clippy::unwrap_used)]

use crate::support::*;
use coact_messages::{KeypointName, NONE, PERSON, ROBOT, SensorSample, Sighting, Truth};
use coact_monitor::SnapshotLog;
use coact_run_records::{Record, RunLog, Snapshot};
use std::path::Path;

/// Kind of the only parts of [`task`].
const PLATE: usize = 0;

/// A run of which snapshots are taken.
struct Watching {
    log: SnapshotLog,
    sample: Box<SensorSample>,
    truth: Truth,
}

impl Watching {
    fn open(report: &Path) -> Self {
        let mut truth: Truth = bytemuck::Zeroable::zeroed();
        truth.chain = NONE;
        let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
        sample.scene.sightings = 2;
        for (sighting, x) in sample.scene.sighting.iter_mut().zip([0.1, 0.2]) {
            *sighting = Sighting { kind: PLATE as u32, position: [x, 0.0, 0.0], ..Sighting::default() };
        }
        Self { log: SnapshotLog::open(report, &task()).unwrap(), sample, truth }
    }

    /// Lets time pass, with a look every 5 ms and a camera frame every 30.
    fn pass(&mut self, ms: u64) {
        for _ in 0..ms {
            self.sample.header.cycle += 1;
            let cycle = self.sample.header.cycle;
            self.sample.scene.captured_cycle = cycle / 30 * 30;
            self.log.sample(&self.sample);
            self.log.truth(&self.truth);
            if cycle.is_multiple_of(5) {
                self.log.look().unwrap();
            }
        }
    }

    /// The hand of `who` has these parts, bit for bit.
    fn holds(&mut self, who: usize, parts: u64) {
        self.truth.held[who] = parts;
        self.pass(50);
    }

    fn achieve(&mut self, achieved: u64) {
        self.truth.achieved = achieved;
        self.pass(50);
    }
}

fn told(report: &Path) -> Vec<String> {
    RunLog::<Snapshot>::read(report).unwrap().into_iter().map(|snapshot| snapshot.what).collect()
}

/// What is told of a run, without its beginning and end.
fn told_of(act: impl FnOnce(&mut Watching)) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.pass(300);
    act(&mut run);
    run.log.finish().unwrap();
    let mut told = told(folder.path());
    assert_eq!(told.remove(0), "the beginning");
    assert_eq!(told.pop().unwrap(), "the end");
    told
}

#[test]
fn a_run_in_which_nothing_happens_has_a_beginning_and_an_end() {
    assert_eq!(told_of(|run| run.pass(3000)), Vec::<String>::new());
}

#[test]
fn a_run_that_ends_before_it_was_seen_has_no_snapshot() {
    let folder = tempfile::tempdir().unwrap();
    Watching::open(folder.path()).log.finish().unwrap();
    assert_eq!(told(folder.path()), Vec::<String>::new());
}

#[test]
fn a_part_is_followed_from_hand_to_hand_into_its_place() {
    let told = told_of(|run| {
        run.holds(PERSON, 0b01);
        run.truth.held[PERSON] = 0;
        run.holds(ROBOT, 0b01);
        run.truth.held[ROBOT] = 0;
        run.achieve(0b01);
    });
    assert_eq!(told, ["person takes plate", "robot takes plate from the person", "in place: lid"]);
}

#[test]
fn a_part_that_two_hands_hold_is_told_once_for_each() {
    let told = told_of(|run| {
        run.holds(ROBOT, 0b01);
        run.holds(PERSON, 0b01);
        run.holds(ROBOT, 0);
    });
    assert_eq!(told, ["robot takes plate", "person takes plate from the robot"]);
}

#[test]
fn a_part_that_comes_out_of_a_hand_is_told_unless_it_is_in_its_place() {
    let told = told_of(|run| {
        run.holds(ROBOT, 0b10);
        run.holds(ROBOT, 0);
        run.holds(PERSON, 0b10);
        run.truth.held[PERSON] = 0;
        run.achieve(0b10);
    });
    let expected =
        ["robot takes plate", "plate leaves the robot's hand", "person takes plate", "in place: hinge"];
    assert_eq!(told, expected);
}

#[test]
fn changes_between_two_looks_are_one_snapshot() {
    let told = told_of(|run| {
        run.truth.held = [0b01, 0b10];
        run.achieve(0b11);
        run.achieve(0);
    });
    let all = "robot takes plate; person takes plate; in place: lid; in place: hinge";
    assert_eq!(told, [all, "the parts are laid out again"]);
}

#[test]
fn a_part_that_the_recogniser_misses_for_a_moment_is_shown_and_one_that_stays_away_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.pass(300);
    run.sample.scene.sightings = 1;
    run.pass(60);
    run.holds(ROBOT, 1);
    run.pass(300);
    run.holds(ROBOT, 0);
    let parts = |snapshot: &Snapshot| snapshot.parts.len();
    assert_eq!(
        RunLog::<Snapshot>::read(folder.path()).unwrap().iter().map(parts).collect::<Vec<_>>(),
        [2, 2, 1]
    );
}

#[test]
fn a_restarted_monitor_goes_on_with_the_log() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.pass(300);
    run.achieve(0b01);
    run.log = SnapshotLog::open(folder.path(), &task()).unwrap();
    run.pass(300);
    run.holds(ROBOT, 1);
    assert_eq!(told(folder.path()), ["the beginning", "in place: lid", "robot takes plate"]);
}

#[test]
fn a_snapshot_tells_who_does_what_and_where_everything_is() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.truth = acting(0, 1, PASS, HINGE, 100, 0);
    run.sample.joints.position[3] = 0.5;
    let wrist = &mut run.sample.hands[0].keypoints[KeypointName::Wrist as usize];
    (wrist.position, wrist.confidence) = ([0.3, 0.4, 0.5], 0.9);
    let mut command: coact_messages::Command = bytemuck::Zeroable::zeroed();
    command.action = RECEIVE_HINGE as u32;
    run.log.command(&command);
    run.pass(300);
    run.truth.achieved = 0b01;
    run.holds(PERSON, 1);
    let text = std::fs::read_to_string(folder.path().join(Snapshot::FILE)).unwrap();
    insta::assert_snapshot!(text.lines().last().unwrap());
}
