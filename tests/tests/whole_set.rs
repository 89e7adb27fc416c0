//! Real processes build together, and leave nothing behind.
#![allow(clippy::unwrap_used)]

use coact_run_records::{Summary, SupervisorEventKind};
use coact_tests::{Launched, alone, left_behind, wait_for};
use rustix::process::{Pid, Signal, test_kill_process};

const CHAIN: [&str; 4] = ["world", "perception", "fields", "control"];

#[test]
fn a_set_builds_at_its_rate_and_reports() {
    let _alone = alone();
    let mut launched = Launched::start(&["--duration", "25", "--world", "kinematic", "--json"]);
    let run = launched.when_started();
    let finished = launched.finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    let code = i32::from(!finished.summary().work.passes());
    assert_eq!(finished.code, Some(code), "{}", finished.stderr);
    assert!(finished.summary().task.achieved >= 1, "{}", finished.stderr);
    for shown in ["decides: ", "says: ", "achieved: "] {
        assert!(finished.stderr.contains(shown), "{shown} is not in {}", finished.stderr);
    }
    for process in CHAIN {
        // The world goes on until the arm has come to rest, up to some tenths of a second. On a machine that others share a stage skips
        // cycles, and says so: at half the rate both together would be 12 500.
        let report = &finished.summary().processes[process];
        let due = report.cycles + report.skipped;
        assert!((24_000..=25_500).contains(&due), "{process}: {report:?} in 25 s");
        assert!(report.cycles > report.skipped, "{process}: {report:?}");
    }
    assert!(finished.summary().refused.is_empty(), "good messages are not refused");
    let printed: Summary = serde_json::from_str(&finished.stdout).unwrap();
    assert_eq!(&printed, finished.summary(), "--json prints the summary and nothing else");
    finished.nobody_died();
}

#[test]
fn two_runs_beside_each_other_both_build() {
    let _alone = alone();
    let start = |seed| Launched::start(&["--world", "kinematic", "--seed", seed]);
    let (mut one, mut other) = (start("1"), start("2"));
    let (first, second) = (one.when_started(), other.when_started());
    assert_ne!(first.prefix(), second.prefix());
    // Two sets of programs that were built for tests leave two cores little: arms stand while what they see is old, and a handover takes
    // more than one try then. So they have as long as it takes.
    for launched in [&one, &other] {
        wait_for("a subgoal that is achieved", || launched.said().contains("achieved: ").then_some(()));
    }
    for (run, launched) in [(first, one), (second, other)] {
        launched.signal(Signal::TERM);
        let finished = launched.finish();
        assert_eq!(left_behind(&run), Vec::<String>::new());
        assert!(finished.summary().task.achieved >= 1, "{}", finished.stderr);
        // For the same reason a stage may wait for longer than it may be silent, and is replaced. Nothing else happens to it.
        let faults = &finished.summary().faults;
        assert!(
            faults.iter().all(|fault| fault.fault.starts_with("hung")),
            "{faults:?}\n{}",
            finished.stderr
        );
    }
}

#[test]
fn an_interrupted_run_is_stopped_in_order_and_reported() {
    let _alone = alone();
    let mut launched = Launched::start(&["--world", "kinematic"]);
    let run = launched.when_started();
    launched.signal(Signal::TERM);
    let finished = launched.finish();
    assert!(matches!(finished.code, Some(0 | 1)), "{}", finished.stderr);
    assert!(
        !finished.summary().environment.kernel.is_empty(),
        "the monitor had the time to write its summary"
    );
    let stopped: Vec<_> =
        finished.supervisor.iter().filter(|event| event.event == SupervisorEventKind::Stopped).collect();
    assert_eq!(stopped.len(), CHAIN.len() + 2);
    assert_eq!(stopped.last().unwrap().process, "monitor");
    assert_eq!(left_behind(&run), Vec::<String>::new());
}

#[test]
fn processes_die_with_a_killed_supervisor_and_the_next_run_removes_its_remains() {
    let _alone = alone();
    let mut launched = Launched::start(&["--world", "kinematic"]);
    let run = launched.when_started();
    let pids: Vec<u32> = CHAIN.iter().map(|name| run.ready(name, 0).unwrap().unwrap().pid).collect();
    launched.signal(Signal::KILL);
    launched.finish();
    wait_for("the death of all processes", || pids.iter().all(|&pid| !lives(pid)).then_some(()));
    assert!(!left_behind(&run).is_empty());
    Launched::start(&["--duration", "0.1", "--world", "kinematic"]).finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
}

/// Exists, and is not a dead process that nobody has reaped yet.
fn lives(pid: u32) -> bool {
    let exists = Pid::from_raw(pid as i32).is_some_and(|pid| test_kill_process(pid).is_ok());
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    exists && !status.contains("State:\tZ") && !status.is_empty()
}
