//! Fields and control die at any tick, and another instance goes on from their newest message, as a standby does: the robot
//! decides the same.
#![allow(clippy::unwrap_used)]

use crate::shipped::{configuration, decision_in, settings};
use coact_fields::Network;
use coact_lockstep::Lockstep;
use coact_messages::FieldFrame;
use coact_period::cycles;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::time::Duration;

/// How often a frame or command is missing, or fields dies, as a fraction of all ticks. Chosen by hand: some hundred times in a run.
const OFTEN: f64 = 0.01;
/// How far the onset of most decisions may move, ticks, by frames that are missing while the same is perceived: each costs a peak that is
/// building up one tick.
const LATER: u64 = 10;
/// How far any may: of 112 decisions of 16 seeds 111 moved by up to 5 ticks, and one by 25. Not shown why; a peak whose evidence stands just
/// at its threshold would wait for its noise, and has another one where frames are missing.
const LATEST: u64 = 50;
/// Decisions in so many that may move by more than [`LATER`].
const SELDOM: usize = 20;

/// So many decisions the script leads to, within this time; undisturbed in 26 s.
const DECISIONS: usize = 7;
const LONGEST: u64 = cycles(Duration::from_secs(60));

/// The first decisions of a run: the tick of each one's onset, and its name.
#[derive(Debug, Default)]
struct Decisions {
    all: Vec<(u64, String)>,
    last: Option<(u64, String)>,
}

impl Decisions {
    fn observe(&mut self, stages: &Lockstep, frame: &FieldFrame) {
        let now = decision_in(frame, stages.task()).map(|name| (frame.decision.since, name.to_owned()));
        if now != self.last && !self.are_complete() {
            self.all.extend(now.clone());
            self.last = now;
        }
    }

    fn are_complete(&self) -> bool {
        self.all.len() == DECISIONS
    }
}

/// A run in which the person follows a script. (A partner who chooses by himself does so otherwise when the robot is a tick later.)
fn scripted(seed: u64) -> Lockstep {
    let script = configuration().join("scenarios/errors-and-requests.toml");
    Lockstep::new(&settings(seed, &format!("script:{}", script.display()))).unwrap()
}

/// The first decisions of a scripted run to which `disturb` happens after each tick.
fn decisions(seed: u64, mut disturb: impl FnMut(&mut Lockstep, &mut Pcg64Mcg)) -> Decisions {
    let (mut stages, mut random) = (scripted(seed), Pcg64Mcg::seed_from_u64(seed));
    let mut decided = Decisions::default();
    while !decided.are_complete() && stages.ticks() < LONGEST {
        stages.step();
        decided.observe(&stages, &stages.frame);
        disturb(&mut stages, &mut random);
    }
    decided
}

/// The differences between the onsets of two runs, ticks; they must have decided the same in the same order.
fn shifts(what: &str, undisturbed: &Decisions, disturbed: &Decisions) -> Vec<u64> {
    let names = |decided: &Decisions| decided.all.iter().map(|(_, name)| name.clone()).collect::<Vec<_>>();
    assert!(undisturbed.are_complete(), "{what}: {undisturbed:?}");
    assert_eq!(names(undisturbed), names(disturbed), "{what}: {undisturbed:?}, then {disturbed:?}");
    let pairs = undisturbed.all.iter().zip(&disturbed.all);
    let shifts: Vec<u64> = pairs.map(|(one, other)| one.0.abs_diff(other.0)).collect();
    println!("{what}: {shifts:?} ticks apart");
    shifts
}

#[test]
fn whoever_takes_over_computes_the_same_bits() {
    for seed in 1..=2 {
        let mut pair = [0, 1].map(|_| Lockstep::new(&settings(seed, "synthetic")).unwrap());
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut died = [0, 0];
        for tick in 0..cycles(Duration::from_secs(20)) {
            pair.iter_mut().for_each(Lockstep::step);
            let [undisturbed, disturbed] = &mut pair;
            let bytes = |stages: &Lockstep| {
                [bytemuck::bytes_of(&*stages.frame), bytemuck::bytes_of(&*stages.command)].concat()
            };
            assert!(bytes(undisturbed) == bytes(disturbed), "seed {seed}, tick {tick}, {died:?} deaths");
            if random.random_bool(OFTEN) {
                disturbed.replace_fields().unwrap();
                died[0] += 1;
            }
            // To make another control takes a while; so it dies less often.
            if random.random_bool(OFTEN / 4.0) && !disturbed.awaits_movement() {
                disturbed.replace_control().unwrap();
                died[1] += 1;
            }
        }
        assert!(died[0] > 100 && died[1] > 20, "{died:?} deaths");
    }
}

/// Two networks perceive the same, one of them not always. (In a run of its own it would soon perceive something else: a robot
/// that sets out a few ticks later finds another movement, and what waits for its end begins up to seconds later.)
#[test]
fn frames_that_are_missing_delay_a_decision_by_ticks() {
    let mut all = Vec::new();
    for seed in 1..=8 {
        let (mut stages, mut random) = (scripted(seed), Pcg64Mcg::seed_from_u64(seed));
        let mut network = Network::new(stages.plan().clone(), stages.task().fingerprint, seed).unwrap();
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        network.rest(&mut frame);
        let mut previous = frame.clone();
        let (mut undisturbed, mut disturbed) = (Decisions::default(), Decisions::default());
        let mut missing = 0;
        for tick in 0..LONGEST {
            stages.step();
            if random.random_bool(OFTEN) {
                missing += 1;
            } else {
                std::mem::swap(&mut frame, &mut previous);
                network.step(tick, Some(&stages.percept), &previous, &mut frame);
            }
            undisturbed.observe(&stages, &stages.frame);
            disturbed.observe(&stages, &frame);
            if undisturbed.are_complete() && disturbed.are_complete() {
                break;
            }
        }
        all.extend(shifts(&format!("seed {seed}, {missing} frames missing"), &undisturbed, &disturbed));
        assert!(missing > 100, "seed {seed}: {missing} missing");
    }
    let later = all.iter().filter(|shift| **shift > LATER).count();
    assert!(later * SELDOM <= all.len() && all.iter().all(|shift| *shift <= LATEST), "{all:?}");
}

#[test]
fn a_frame_that_is_missing_changes_no_decision() {
    for seed in 1..=3 {
        let mut missing = 0;
        let disturbed = decisions(seed, |stages, random| {
            if random.random_bool(OFTEN) {
                stages.hang_fields(1);
                missing += 1;
            }
        });
        let what = format!("seed {seed}, {missing} frames missing");
        shifts(&what, &decisions(seed, |_, _| ()), &disturbed);
        assert!(missing > 100, "{what}");
    }
}

/// The arm then moves a little otherwise, and what waits for it begins up to seconds later: a hand that is met in a handover.
#[test]
fn a_command_that_is_missing_and_a_query_that_dies_with_control_change_no_decision() {
    let mut died = 0;
    for seed in 1..=3 {
        let mut missing = 0;
        let disturbed = decisions(seed, |stages, random| {
            if random.random_bool(OFTEN) {
                stages.hang_control(1);
                missing += 1;
            }
            if stages.awaits_movement() && random.random_bool(0.5) {
                stages.replace_control().unwrap();
                died += 1;
            }
        });
        let what = format!("seed {seed}, {missing} commands missing, {died} queries lost so far");
        shifts(&what, &decisions(seed, |_, _| ()), &disturbed);
        assert!(missing > 100, "{what}");
    }
    assert!(died > 5, "only {died} queries lost");
}
