//! The album of a run, from hand-made messages: what makes a moment, and what a moment tells.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{KeypointName, NONE, PERSON, Percept, ROBOT, SensorSample, Sighting, Truth};
use coact_monitor::{Album, Moment};
use std::path::Path;
use support::*;

/// Kind of the only parts of [`task`].
const PLATE: usize = 0;

/// A run that is watched for an album.
struct Watching {
    album: Album,
    sample: Box<SensorSample>,
    percept: Box<Percept>,
    truth: Truth,
}

impl Watching {
    fn open(report: &Path) -> Self {
        let mut truth: Truth = bytemuck::Zeroable::zeroed();
        truth.chain = NONE;
        let (mut sample, percept) = (bytemuck::zeroed_box::<SensorSample>(), bytemuck::zeroed_box());
        sample.scene.sightings = 2;
        for (sighting, x) in sample.scene.sighting.iter_mut().zip([0.1, 0.2]) {
            *sighting = Sighting { kind: PLATE as u32, position: [x, 0.0, 0.0], ..Sighting::default() };
        }
        Self { album: Album::open(report, &task()).unwrap(), sample, percept, truth }
    }

    /// Lets time pass, with a look every 5 ms and a camera frame every 30.
    fn pass(&mut self, ms: u64) {
        for _ in 0..ms {
            self.sample.header.cycle += 1;
            let cycle = self.sample.header.cycle;
            self.sample.scene.captured_cycle = cycle / 30 * 30;
            self.album.sample(&self.sample);
            self.album.percept(&self.percept);
            self.album.truth(&self.truth);
            if cycle.is_multiple_of(5) {
                self.album.look().unwrap();
            }
        }
    }

    fn holds(&mut self, who: usize, evidence: f64) {
        let holds = if who == ROBOT { &mut self.percept.robot_holds } else { &mut self.percept.person_holds };
        holds[PLATE] = evidence;
        self.pass(50);
    }

    fn achieve(&mut self, achieved: u64) {
        self.truth.achieved = achieved;
        self.pass(50);
    }
}

fn told(report: &Path) -> Vec<String> {
    Album::read(report).unwrap().into_iter().map(|moment| moment.what).collect()
}

/// What is told of a run, without its beginning and end.
fn told_of(act: impl FnOnce(&mut Watching)) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.pass(300);
    act(&mut run);
    run.album.finish().unwrap();
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
fn a_run_that_ends_before_it_was_seen_has_no_moment() {
    let folder = tempfile::tempdir().unwrap();
    Watching::open(folder.path()).album.finish().unwrap();
    assert_eq!(told(folder.path()), Vec::<String>::new());
}

#[test]
fn a_part_is_followed_from_hand_to_hand_into_its_place() {
    let told = told_of(|run| {
        run.holds(PERSON, 1.0);
        run.holds(ROBOT, 1.0);
        run.holds(PERSON, 0.0);
        run.achieve(0b01);
        run.holds(ROBOT, 0.0);
    });
    assert_eq!(told, ["person takes plate", "robot takes plate from the person", "in place: lid"]);
}

#[test]
fn a_part_that_is_let_go_elsewhere_is_told() {
    let told = told_of(|run| {
        run.holds(ROBOT, 1.0);
        run.achieve(0b01);
        run.holds(ROBOT, 0.0);
        run.holds(ROBOT, 1.0);
        run.holds(ROBOT, 0.0);
    });
    assert_eq!(told, ["robot takes plate", "in place: lid", "robot takes plate", "robot lets go of plate"]);
}

#[test]
fn evidence_that_wavers_makes_no_moment() {
    let told = told_of(|run| {
        for evidence in [0.7, 0.2, 0.8, 0.3, 1.0, 0.4, 1.0] {
            run.holds(ROBOT, evidence);
        }
    });
    assert_eq!(told, ["robot takes plate"]);
}

#[test]
fn changes_between_two_looks_are_one_moment() {
    let told = told_of(|run| {
        run.percept.person_holds[PLATE] = 1.0;
        run.achieve(0b11);
        run.achieve(0);
    });
    assert_eq!(told, ["person takes plate; in place: lid; in place: hinge", "the parts are laid out again"]);
}

#[test]
fn a_part_that_the_recogniser_misses_for_a_moment_is_shown_and_one_that_stays_away_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.pass(300);
    run.sample.scene.sightings = 1;
    run.pass(60);
    run.holds(ROBOT, 1.0);
    run.pass(300);
    run.holds(ROBOT, 0.0);
    let parts = |moment: &Moment| moment.parts.len();
    assert_eq!(Album::read(folder.path()).unwrap().iter().map(parts).collect::<Vec<_>>(), [2, 2, 1]);
}

#[test]
fn a_restarted_monitor_goes_on_with_the_album() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.pass(300);
    run.achieve(0b01);
    run.holds(PERSON, 1.0);
    run.album = Album::open(folder.path(), &task()).unwrap();
    run.pass(300);
    run.holds(ROBOT, 1.0);
    let expected =
        ["the beginning", "in place: lid", "person takes plate", "robot takes plate from the person"];
    assert_eq!(told(folder.path()), expected);
}

#[test]
fn a_moment_tells_who_does_what_and_where_everything_is() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Watching::open(folder.path());
    run.truth = acting(0, 1, PASS, HINGE, 100, 0);
    run.sample.joints.position[3] = 0.5;
    let wrist = &mut run.sample.hand.keypoints[KeypointName::Wrist as usize];
    (wrist.position, wrist.confidence) = ([0.3, 0.4, 0.5], 0.9);
    let mut command: coact_messages::Command = bytemuck::Zeroable::zeroed();
    command.action = TAKE_HINGE as u32;
    run.album.command(&command);
    run.pass(300);
    run.truth.achieved = 0b01;
    run.holds(PERSON, 1.0);
    let text = std::fs::read_to_string(folder.path().join(Album::FILE)).unwrap();
    insta::assert_snapshot!(text.lines().last().unwrap());
}
