//! Counters of a process, from its pulses.

mod support;

use coact_messages::Pulse;
use coact_monitor::{CycleMisses, ProcessCounters};
use support::pulse;

fn counted(sequence: u64, generation: u32, missed: u64, skipped: u64) -> Pulse {
    let mut pulse = pulse(sequence, 0);
    pulse.header.generation = generation;
    (pulse.missed, pulse.skipped) = (missed, skipped);
    pulse
}

fn counters(pulses: &[Pulse]) -> ProcessCounters {
    let mut counters = ProcessCounters::default();
    for pulse in pulses {
        counters.add(pulse);
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
fn each_cycle_tells_what_it_added() {
    let mut counters = ProcessCounters::default();
    counters.add(&counted(0, 0, 2, 1));
    assert_eq!(counters.add(&counted(1, 0, 3, 5)), CycleMisses { missed: 1, skipped: 4 });
    assert_eq!(counters.add(&counted(2, 0, 3, 5)), CycleMisses::default());
}

#[test]
fn what_was_before_a_late_reader_connected_is_not_counted() {
    let counters = counters(&[counted(500, 0, 70, 9), counted(501, 0, 71, 9)]);
    assert_eq!((counters.cycles, counters.missed, counters.longest_miss_run, counters.skipped), (2, 1, 1, 0));
}
