//! Processes that stop, wait, compute without end or have no core: who is killed, and when.
#![allow(clippy::unwrap_used)]

mod trial;

use coact_run_records::SupervisorEventKind;
use coact_supervisor::{Fault, RunningChild};
use std::time::{Duration, Instant};
use trial::{READY_AND_RUN, Trial, script};

#[test]
fn a_stopped_process_goes_on_after_its_pause_when_silence_is_allowed() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    let pid = trial.pid("a");
    let state = |_: &Trial| std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap().contains(") T ");
    trial.set.inject("a", Fault::Stop).unwrap();
    trial.until(&mut (), state).unwrap();
    trial.until(&mut (), |trial| !state(trial)).unwrap();
    assert_eq!(trial.count(SupervisorEventKind::Died, "a"), 0);
}

#[test]
fn a_stopped_process_is_killed_as_hung_and_replaced_at_once_and_a_silent_one_after_a_while() {
    for fault in [Some(Fault::Stop), None] {
        let mut trial = Trial::with(&[("a", READY_AND_RUN), ("b", READY_AND_RUN)], |spec| {
            spec.hung_after = (spec.name == "a").then_some(Duration::from_millis(100));
        });
        trial.run_until_ready();
        trial.set.expect_pulses(coact_realtime::monotonic_time());
        fault.into_iter().for_each(|fault| trial.set.inject("a", fault).unwrap());
        trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
        let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
        // The script does not say that it is real time: silent, it gets as long as machines are late.
        let within = if fault.is_some() { "1 ms" } else { "500 ms" };
        assert_eq!(died.reason.as_deref(), Some(&*format!("hung: no pulse for more than {within}")));
        assert_eq!(died.fault.as_deref(), fault.map(|fault| fault.name()));
    }
}

/// Reports that it has real-time scheduling, as services do that were granted it: all at once.
const REALTIME_READY_AND_RUN: &str = r#"cat > "$READY.new" <<END
{"process": "a", "generation": 0, "pid": 1, "scheduler": "SCHED_FIFO", "priority": 80, "core": null,
 "memory_locked": false, "why_not": [], "resumed": false}
END
mv "$READY.new" "$READY"
exec sleep 600"#;

#[test]
fn a_real_time_process_that_sleeps_while_another_goes_on_is_replaced_within_milliseconds() {
    // What sleeps may be silent for 3 % of it.
    let (limit, within) = (Duration::from_millis(400), Duration::from_millis(12));
    let scripts = [("a", REALTIME_READY_AND_RUN), ("b", REALTIME_READY_AND_RUN)];
    let mut trial = Trial::with(&scripts, |spec| spec.hung_after = Some(limit));
    trial.run_until_ready();
    trial.set.expect_pulses(coact_realtime::monotonic_time());
    let begin = Instant::now();
    let (mut turns, mut last_pulse) = (0, Instant::now());
    while trial.count(SupervisorEventKind::Died, "a") == 0 {
        assert!(begin.elapsed() < Duration::from_secs(30), "{:?}", trial.events);
        trial.set.wait(Duration::from_millis(2));
        // Both send pulses for a while; then a falls silent.
        turns += 1;
        if turns < 20 {
            last_pulse = Instant::now();
            trial.set.pulse("a");
        }
        trial.set.pulse("b");
        trial.set.advance(&mut ()).unwrap();
        trial.events.extend(trial.set.take_events());
    }
    let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
    // A machine that is late itself gets more time.
    assert_eq!((&*died.process, died.reason.as_deref()), ("a", Some("hung: no pulse for more than 12 ms")));
    // A pulse counts from the look before it, which is 4 ms ago at most.
    let silent = last_pulse.elapsed();
    assert!(silent > within - Duration::from_millis(4), "killed after {silent:?}");
}

/// What the test below supervises.
#[test]
#[ignore = "a process of another test"]
fn computes_in_the_background() {
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let begin = Instant::now();
            while begin.elapsed() < Duration::from_secs(60) {}
        });
    });
}

#[test]
fn who_computes_in_the_background_does_not_certainly_hang() {
    let program = std::env::current_exe().unwrap();
    let background = format!(
        "touch \"$READY\"; exec '{}' --ignored --exact computes_in_the_background",
        program.display()
    );
    let mut trial =
        Trial::with(&[("a", &background)], |spec| spec.hung_after = Some(Duration::from_millis(100)));
    trial.run_until_ready();
    trial.set.expect_pulses(coact_realtime::monotonic_time());
    trial.set.pulse("a");
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Died, "a") == 1).unwrap();
    let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
    // Its main thread waits. What computes without end is killed after 10 ms.
    assert_eq!(died.reason.as_deref(), Some("hung: no pulse for more than 500 ms"));
}

#[test]
fn a_process_whose_heartbeat_stops_is_replaced_and_one_that_never_had_any_is_not() {
    let beats = "touch \"$READY\"; for beat in 1 2 3 4 5 6 7 8; do touch \"$DIR/a.heartbeat\"; sleep 0.1; done; exec sleep 600";
    let mut trial = Trial::of(&[("a", beats), ("b", READY_AND_RUN)]);
    trial.run_until_ready();
    let begin = Instant::now();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    assert!(begin.elapsed() > Duration::from_millis(1500), "it beat for 0.7 s, and had another second");
    let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
    assert_eq!(
        (died.process.as_str(), died.reason.as_deref()),
        ("a", Some("hung: no heartbeat for more than 1000 ms"))
    );
    assert_eq!(trial.count(SupervisorEventKind::Died, "b"), 0);
}

#[test]
fn a_process_whose_heartbeat_stops_because_others_have_its_core_is_waited_for() {
    let begins = "touch \"$READY\"; for beat in 1 2 3; do touch \"$DIR/a.heartbeat\"; sleep 0.1; done;";
    let forever = "while :; do :; done";
    // Beside anything else on its core, it gets a three hundredth of it.
    let starves = format!("{begins} exec taskset -c 0 chrt -i 0 sh -c '{forever}'");
    let folder = tempfile::tempdir().unwrap();
    let hog = script(folder.path(), "hog", &format!("exec taskset -c 0 sh -c '{forever}'"));
    let hog = RunningChild::spawn(&hog, 0, |_| ()).unwrap();
    let mut trial = Trial::of(&[("a", &starves)]);
    trial.run_until_ready();
    let begin = Instant::now();
    trial.until(&mut (), |_| begin.elapsed() > Duration::from_secs(4)).unwrap();
    assert_eq!(trial.count(SupervisorEventKind::Died, "a"), 0, "{:?}", trial.events);
    drop(hog);
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Died, "a") == 1).unwrap();
    let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
    assert_eq!(died.reason.as_deref(), Some("hung: no heartbeat for more than 1000 ms"));
}
