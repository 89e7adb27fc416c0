//! Detection, recovery and survivors' misses from hand-made pulses and supervisor's lines.
#![allow(clippy::unwrap_used)]

mod support;

use coact_monitor::{CycleMisses, Faults};
use coact_run_records::{Event, FaultEvent, SupervisorEvent, SupervisorEventKind};
use support::pulse;

const MS: u64 = 1_000_000;

fn seen(event: SupervisorEventKind, process: &str, generation: u32, at_ms: u64) -> SupervisorEvent {
    let fault = (event == SupervisorEventKind::Injected).then(|| "kill".into());
    let reason = (event == SupervisorEventKind::Died).then(|| "signal 9".into());
    SupervisorEvent { at_ns: at_ms * MS, event, process: process.into(), generation, pid: 7, fault, reason }
}

fn set() -> Faults {
    Faults::new(vec!["fields".into(), "control".into(), "world".into()])
}

/// A pulse of `generation`, published at about `at_ms`.
fn beat(faults: &mut Faults, process: &str, generation: u32, at_ms: u64, missed: u64) {
    let mut pulse = pulse(at_ms - 1, 0);
    pulse.header.generation = generation;
    faults.pulse(process, &pulse, CycleMisses { missed, skipped: 0 });
}

fn settled(faults: &mut Faults, at_ms: u64) -> Vec<FaultEvent> {
    let mut events = Vec::new();
    faults.settle(at_ms * MS, &mut events);
    events
        .into_iter()
        .map(|event| match event {
            Event::Fault(fault) => fault,
            other => panic!("{other:?}"),
        })
        .collect()
}

#[test]
fn kill_is_detected_recovered_and_its_cost_to_others_counted() {
    let mut faults = set();
    beat(&mut faults, "control", 0, 90, 1); // before the fault: not its cost
    faults.supervisor(&seen(SupervisorEventKind::Injected, "fields", 0, 100));
    beat(&mut faults, "fields", 0, 101, 0); // sent before the signal arrived: no recovery
    beat(&mut faults, "control", 0, 102, 1);
    beat(&mut faults, "control", 0, 103, 1);
    beat(&mut faults, "world", 0, 103, 1);
    faults.supervisor(&seen(SupervisorEventKind::Died, "fields", 0, 104));
    beat(&mut faults, "fields", 1, 120, 1); // its own misses are no survivor's
    beat(&mut faults, "control", 0, 150, 1); // after the recovery
    assert_eq!(settled(&mut faults, 200), [], "other pulses may still be on their way");
    let fault = settled(&mut faults, 400).remove(0);
    assert_eq!((fault.process.as_str(), fault.fault.as_str()), ("fields", "kill"));
    assert_eq!(fault.detected_ms, Some(4.0));
    assert_eq!(fault.recovered_ms, Some(20.1));
    assert_eq!(
        fault.survivors_missed.into_iter().collect::<Vec<_>>(),
        [("control".into(), 2), ("world".into(), 1)]
    );
    assert_eq!(settled(&mut faults, 4000), []);
}

#[test]
fn death_that_nobody_asked_for_is_a_fault_too() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Died, "world", 0, 50));
    beat(&mut faults, "world", 1, 80, 0);
    let fault = settled(&mut faults, 1000).remove(0);
    assert_eq!((fault.fault.as_str(), fault.detected_ms), ("signal 9", Some(0.0)));
    assert_eq!(fault.recovered_ms, Some(30.1));
}

#[test]
fn a_replacement_that_dies_too_belongs_to_the_same_fault() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Injected, "fields", 0, 100));
    faults.supervisor(&seen(SupervisorEventKind::Died, "fields", 0, 101));
    faults.supervisor(&seen(SupervisorEventKind::Died, "fields", 1, 140));
    beat(&mut faults, "fields", 2, 200, 0);
    let all = settled(&mut faults, 1000);
    assert_eq!(all.len(), 1);
    assert_eq!((all[0].detected_ms, all[0].recovered_ms), (Some(1.0), Some(100.1)));
}

#[test]
fn a_disturbed_process_has_recovered_after_its_last_late_cycle() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Injected, "fields", 0, 100));
    for (at, missed) in [(101, 0), (102, 1), (103, 1), (104, 0), (105, 1), (106, 0), (107, 0)] {
        beat(&mut faults, "fields", 0, at, missed);
    }
    let fault = settled(&mut faults, 1000).remove(0);
    assert_eq!((fault.detected_ms, fault.recovered_ms), (None, Some(6.1)));
}

#[test]
fn a_process_without_pulses_has_recovered_when_it_is_ready() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Injected, "voice", 0, 100));
    faults.supervisor(&seen(SupervisorEventKind::Died, "voice", 0, 102));
    faults.supervisor(&seen(SupervisorEventKind::Ready, "voice", 1, 130));
    assert_eq!(settled(&mut faults, 1000)[0].recovered_ms, Some(30.0));
}

#[test]
fn a_process_that_is_given_up_never_recovers() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Died, "fields", 0, 100));
    faults.supervisor(&seen(SupervisorEventKind::GaveUp, "fields", 0, 101));
    assert_eq!(settled(&mut faults, 1000)[0].recovered_ms, None);
}

#[test]
fn a_restarted_monitor_does_not_report_a_fault_twice() {
    let (mut faults, mut restarted) = (set(), set());
    let lines = [
        seen(SupervisorEventKind::Injected, "fields", 0, 100),
        seen(SupervisorEventKind::Died, "fields", 0, 101),
    ];
    lines.iter().for_each(|line| faults.supervisor(line));
    beat(&mut faults, "fields", 1, 120, 0);
    let told = settled(&mut faults, 1000).into_iter().map(Event::Fault).collect::<Vec<_>>();
    restarted.resume(&told);
    lines.iter().for_each(|line| restarted.supervisor(line));
    beat(&mut restarted, "fields", 1, 2000, 0);
    assert_eq!(settled(&mut restarted, 9000), []);
    restarted.supervisor(&seen(SupervisorEventKind::Died, "fields", 1, 3000));
    beat(&mut restarted, "fields", 2, 3020, 0);
    assert_eq!(settled(&mut restarted, 9000).len(), 1);
}
