//! Detection, recovery and survivors' misses from hand-made pulses and supervisor's lines.
#![allow(clippy::unwrap_used)]

use crate::support::pulse;
use coact_monitor::Faults;
use coact_realtime::LateWakeUp;
use coact_run_records::{Event, FaultEvent, SupervisorEvent, SupervisorEventKind};

const MS: u64 = 1_000_000;

fn seen(event: SupervisorEventKind, process: &str, generation: u32, at_ms: u64) -> SupervisorEvent {
    let fault = (event == SupervisorEventKind::Injected).then(|| "kill".into());
    let reason = (event == SupervisorEventKind::Died).then(|| "signal 9".into());
    SupervisorEvent {
        at_ns: at_ms * MS,
        event,
        process: process.into(),
        generation,
        pid: 7,
        fault,
        reason,
        user: None,
    }
}

fn set() -> Faults {
    Faults::new(vec!["fields".into(), "control".into(), "world".into()])
}

/// A pulse of `generation`, published at `at_ms` and 0.1 ms, or a period later when `late`.
fn beat(faults: &mut Faults, process: &str, generation: u32, at_ms: u64, late: bool) {
    let mut pulse = pulse(at_ms - 1, if late { MS } else { 0 });
    pulse.header.generation = generation;
    faults.pulse(process, &pulse, u64::from(late));
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
    beat(&mut faults, "control", 0, 90, true); // before the fault: not its cost
    faults.supervisor(&seen(SupervisorEventKind::Injected, "fields", 0, 100));
    beat(&mut faults, "fields", 0, 101, false); // published before the signal arrived: its last good output
    beat(&mut faults, "control", 0, 102, true);
    beat(&mut faults, "control", 0, 103, true);
    beat(&mut faults, "world", 0, 103, true);
    faults.supervisor(&seen(SupervisorEventKind::Died, "fields", 0, 104));
    beat(&mut faults, "fields", 1, 119, true); // late: no good output, and no survivor's
    beat(&mut faults, "fields", 1, 121, false);
    beat(&mut faults, "control", 0, 150, true); // after the recovery
    assert_eq!(settled(&mut faults, 200), [], "other pulses may still be on their way");
    let fault = settled(&mut faults, 400).remove(0);
    assert_eq!((fault.process.as_str(), fault.fault.as_str()), ("fields", "kill"));
    assert_eq!(fault.at_ns, 101 * MS + MS / 10);
    assert_eq!((fault.detected_ms, fault.recovered_ms), (Some(2.9), Some(20.0)));
    assert_eq!(
        fault.survivors_missed.into_iter().collect::<Vec<_>>(),
        [("control".into(), 2), ("world".into(), 1)]
    );
    assert_eq!(settled(&mut faults, 4000), []);
}

#[test]
fn a_fault_tells_the_longest_lateness_of_the_machine_meanwhile() {
    let lateness = |late: &[(u64, u64)]| {
        let mut faults = set();
        late.iter().for_each(|&(due, woken)| {
            faults.machine_late(LateWakeUp { due_ns: due * MS, woken_ns: woken * MS })
        });
        beat(&mut faults, "fields", 0, 100, false);
        faults.supervisor(&seen(SupervisorEventKind::Died, "fields", 0, 104));
        beat(&mut faults, "fields", 1, 121, false);
        settled(&mut faults, 400).remove(0).machine_late_ms
    };
    assert_eq!(lateness(&[]), 0.0);
    assert_eq!(lateness(&[(90, 99), (123, 140)]), 0.0, "before it, and after it");
    assert_eq!(lateness(&[(110, 112), (99, 104), (119, 121)]), 5.0);
    assert_eq!(lateness(&[(80, 180)]), 100.0);
}

#[test]
fn a_fault_that_nobody_asked_for_begins_with_the_last_good_output_before_it() {
    let mut faults = set();
    (1..500).for_each(|at| beat(&mut faults, "control", 0, at, false));
    // It hung for 2.5 s before anybody noticed.
    faults.supervisor(&seen(SupervisorEventKind::Died, "control", 0, 2999));
    beat(&mut faults, "control", 1, 3019, false);
    let fault = settled(&mut faults, 4000).remove(0);
    assert_eq!((fault.fault.as_str(), fault.at_ns), ("signal 9", 499 * MS + MS / 10));
    assert_eq!((fault.detected_ms, fault.recovered_ms), (Some(2499.9), Some(2520.0)));
}

#[test]
fn pulses_that_are_read_after_the_record_of_a_death_count_by_their_stamps() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Died, "world", 0, 50));
    (40..49).for_each(|at| beat(&mut faults, "world", 0, at, false));
    beat(&mut faults, "world", 1, 80, false);
    let fault = settled(&mut faults, 1000).remove(0);
    assert_eq!(fault.at_ns, 48 * MS + MS / 10);
    assert_eq!((fault.detected_ms, fault.recovered_ms), (Some(1.9), Some(32.0)));
}

#[test]
fn a_process_that_never_published_has_failed_when_that_was_seen() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Died, "world", 0, 50));
    beat(&mut faults, "world", 1, 80, false);
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
    beat(&mut faults, "fields", 2, 200, false);
    let all = settled(&mut faults, 1000);
    assert_eq!(all.len(), 1);
    assert_eq!((all[0].detected_ms, all[0].recovered_ms), (Some(1.0), Some(100.1)));
}

#[test]
fn a_disturbed_process_has_recovered_after_its_last_late_cycle() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Injected, "fields", 0, 100));
    for (at, late) in
        [(101, false), (102, true), (103, true), (104, false), (105, true), (107, false), (108, false)]
    {
        beat(&mut faults, "fields", 0, at, late);
    }
    let fault = settled(&mut faults, 1000).remove(0);
    assert_eq!(fault.at_ns, 101 * MS + MS / 10, "the fault took effect after that");
    assert_eq!((fault.detected_ms, fault.recovered_ms), (None, Some(6.0)));
}

#[test]
fn a_fault_without_effect_was_over_at_once() {
    let mut faults = set();
    faults.supervisor(&seen(SupervisorEventKind::Injected, "fields", 0, 100));
    (101..400).for_each(|at| beat(&mut faults, "fields", 0, at, false));
    assert_eq!(settled(&mut faults, 1000)[0].recovered_ms, Some(0.0));
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
fn a_fault_without_recovery_is_not_reported_twice_either() {
    let mut faults = set();
    beat(&mut faults, "fields", 0, 99, false);
    let died = seen(SupervisorEventKind::Died, "fields", 0, 100);
    faults.supervisor(&died);
    faults.supervisor(&seen(SupervisorEventKind::GaveUp, "fields", 0, 101));
    let told = settled(&mut faults, 1000).into_iter().map(Event::Fault).collect::<Vec<_>>();
    let mut restarted = set();
    restarted.resume(&told);
    restarted.supervisor(&died);
    assert_eq!(settled(&mut restarted, 9000), []);
}

#[test]
fn a_restarted_monitor_does_not_report_a_fault_twice() {
    let (mut faults, mut restarted) = (set(), set());
    let lines = [
        seen(SupervisorEventKind::Injected, "fields", 0, 100),
        seen(SupervisorEventKind::Died, "fields", 0, 101),
    ];
    lines.iter().for_each(|line| faults.supervisor(line));
    beat(&mut faults, "fields", 1, 120, false);
    let told = settled(&mut faults, 1000).into_iter().map(Event::Fault).collect::<Vec<_>>();
    restarted.resume(&told);
    lines.iter().for_each(|line| restarted.supervisor(line));
    beat(&mut restarted, "fields", 1, 2000, false);
    assert_eq!(settled(&mut restarted, 9000), []);
    restarted.supervisor(&seen(SupervisorEventKind::Died, "fields", 1, 3000));
    beat(&mut restarted, "fields", 2, 3020, false);
    assert_eq!(settled(&mut restarted, 9000).len(), 1);
}
