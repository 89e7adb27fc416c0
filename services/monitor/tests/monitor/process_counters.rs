//! Counters of a process, from its pulses.

use crate::support::pulse;
use coact_messages::Pulse;
use coact_monitor::{CycleFindings, ProcessCounters};

/// Far older than what a pulse of these tests descends from.
const FRESH_NS: u64 = 50_000_000;

fn counted(sequence: u64, generation: u32, missed: u64, skipped: u64) -> Pulse {
    let mut pulse = pulse(sequence, 0);
    pulse.header.generation = generation;
    (pulse.missed, pulse.skipped) = (missed, skipped);
    pulse
}

fn counters(pulses: &[Pulse]) -> ProcessCounters {
    let mut counters = ProcessCounters::default();
    for pulse in pulses {
        counters.add(pulse, FRESH_NS);
    }
    counters
}

#[test]
fn the_longest_run_is_that_of_consecutive_misses() {
    let missed = [0, 1, 2, 2, 3, 4, 5, 5, 6];
    let pulses: Vec<Pulse> = (0..).zip(missed).map(|(cycle, missed)| counted(cycle, 0, missed, 0)).collect();
    let counters = counters(&pulses);
    assert_eq!((counters.cycles, counters.missed, counters.longest_miss_run), (9, 6, 3));
}

#[test]
fn a_restart_begins_its_counters_anew_and_loses_nothing() {
    let pulses = [counted(0, 0, 0, 0), counted(1, 0, 1, 2), counted(2, 1, 0, 0), counted(3, 1, 1, 1)];
    let counters = counters(&pulses);
    assert_eq!((counters.cycles, counters.missed, counters.skipped, counters.restarts), (4, 2, 3, 1));
    assert_eq!(counters.longest_miss_run, 1);
}

#[test]
fn pulses_that_were_lost_are_made_up_for() {
    let counters = counters(&[counted(0, 0, 0, 0), counted(10, 0, 4, 0)]);
    assert_eq!((counters.cycles, counters.missed, counters.longest_miss_run), (11, 4, 4));
}

#[test]
fn each_pulse_tells_what_was_missing_since_the_one_before() {
    let mut counters = ProcessCounters::default();
    counters.add(&pulse(0, 0), FRESH_NS);
    // Four cycles were skipped: the sequence goes on by one, the cycle by five.
    let mut after = pulse(5, 0);
    (after.header.sequence, after.skipped) = (1, 4);
    assert_eq!(counters.add(&after, FRESH_NS), CycleFindings { outage: 4, unseen: 0 });
    let mut late = pulse(6, 1_000_000);
    (late.header.sequence, late.skipped, late.missed) = (2, 4, 1);
    assert_eq!(counters.add(&late, FRESH_NS), CycleFindings { outage: 1, unseen: 0 });
    let mut good = pulse(7, 0);
    (good.header.sequence, good.skipped, good.missed) = (3, 4, 1);
    assert_eq!(counters.add(&good, FRESH_NS), CycleFindings::default());
    let found = counters.outage.until(8);
    assert_eq!((found.due, found.without_output, found.longest, found.longest_from_ms), (8, 5, 4, 0));
}

#[test]
fn an_absent_process_is_missing_for_ten_seconds_although_it_missed_no_deadline() {
    let mut counters = ProcessCounters::default();
    (0..5000).for_each(|cycle| {
        counters.add(&counted(cycle, 0, 0, 0), FRESH_NS);
    });
    assert_eq!(counters.missed, 0);
    let found = counters.outage.until(15_000);
    assert_eq!((found.without_output, found.longest, found.longest_from_ms), (10_000, 10_000, 4999));
    // Its replacement goes on with the sequence of the checkpoint, or begins anew: the time between is missing in both.
    for sequence in [4998, 0] {
        let mut replaced = counters.clone();
        let mut first = counted(15_000, 1, 0, 0);
        first.header.sequence = sequence;
        assert_eq!(replaced.add(&first, FRESH_NS).outage, 10_000);
        assert_eq!(replaced.outage.until(15_001).longest, 10_000);
    }
}

#[test]
fn pulses_that_were_lost_are_unseen_and_no_outage() {
    let mut counters = ProcessCounters::default();
    counters.add(&counted(0, 0, 0, 0), FRESH_NS);
    assert_eq!(counters.add(&counted(1000, 0, 3, 0), FRESH_NS), CycleFindings { outage: 3, unseen: 999 });
    assert_eq!(counters.unseen, 999);
}

#[test]
fn an_output_from_old_data_is_timely_and_not_good() {
    let mut counters = ProcessCounters::default();
    for cycle in 0..200 {
        let mut pulse = pulse(cycle, 0);
        // From cycle 100 on no new sensor sample comes.
        pulse.header.sensor_ns = pulse.header.sensor_ns.min(100 * 1_000_000);
        counters.add(&pulse, FRESH_NS);
    }
    assert_eq!(counters.outage.until(200).without_output, 0);
    let found = counters.outage_on_fresh_data.until(200);
    assert!((50..=52).contains(&found.without_output), "{found:?}");
    assert_eq!(found.longest, found.without_output);
}

#[test]
fn what_was_before_a_late_reader_connected_is_not_counted() {
    let counters = counters(&[counted(500, 0, 70, 9), counted(501, 0, 71, 9)]);
    assert_eq!((counters.cycles, counters.missed, counters.longest_miss_run, counters.skipped), (2, 1, 1, 0));
}
