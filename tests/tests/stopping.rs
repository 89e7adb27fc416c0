//! What an operator has stopped stands, whatever dies, until an operator lets it go on.
#![allow(clippy::unwrap_used)]

use coact_pipeline::Run;
use coact_run_records::{SupervisorEvent, SupervisorEventKind};
use coact_tests::{JointViewer, Launched, alone, operate, wait_for};
use rustix::process::{Pid, Signal, kill_process};
use std::fs::DirBuilder;
use std::os::unix::fs::DirBuilderExt;

const RUN: [&str; 4] = ["--duration", "120", "--world", "kinematic"];

/// Kills a process of the set, and waits for its replacement.
fn kill(run: &Run, process: &str, generation: u32) {
    let pid = run.ready(process, generation).unwrap().unwrap().pid;
    kill_process(Pid::from_raw(pid.cast_signed()).unwrap(), Signal::KILL).unwrap();
    wait_for(process, || run.ready(process, generation + 1).unwrap());
}

#[test]
fn a_stopped_arm_stands_whatever_dies_and_moves_again_when_it_may() {
    let _alone = alone();
    let mut launched = Launched::start(&RUN);
    let run = launched.when_started();
    let mut viewer = JointViewer::join(&run);
    viewer.until_fast();
    let (code, said, stopper) = operate(&["stop", "--run", run.id()]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("stopped; coact resume"), "{said}");
    let stood = viewer.until_it_stands();
    for (process, generation) in [("control", 0), ("world", 0), ("fields", 0), ("world", 1)] {
        kill(&run, process, generation);
        viewer.sees_it_stay(&stood);
    }
    let (code, said, _) = operate(&["stop", "--run", run.id()]);
    assert_eq!(code, Some(0));
    assert!(said.contains(&format!("already stopped, by user {} (pid {stopper})", user())), "{said}");
    viewer.sees_it_stay(&stood);
    let (code, said, _) = operate(&["resume", "--run", run.id()]);
    assert_eq!(code, Some(0));
    assert!(said.contains("may go on"), "{said}");
    viewer.until_fast();
    let (code, said, _) = operate(&["resume", "--run", run.id()]);
    assert_eq!(code, Some(0));
    assert!(said.contains("not stopped"), "{said}");
    launched.signal(Signal::TERM);
    let finished = launched.finish();
    for kind in [SupervisorEventKind::OperatorStopped, SupervisorEventKind::OperatorResumed] {
        assert_eq!(finished.count(kind, SupervisorEvent::OPERATOR), 1, "{:?}", finished.supervisor);
    }
    let is_stop = |event: &&SupervisorEvent| event.event == SupervisorEventKind::OperatorStopped;
    let stop = finished.supervisor.iter().find(is_stop).unwrap();
    assert_eq!((stop.pid, stop.user), (stopper, Some(user())));
    let [told] = finished.summary().operator_stops.as_slice() else {
        panic!("{:?}", finished.summary().operator_stops);
    };
    assert!(told.by.contains(&stopper.to_string()) && told.resumed_at_s.is_some_and(|at| at > told.at_s));
    assert!(finished.stderr.contains("stopped by user"), "{}", finished.stderr);
}

#[test]
fn an_arm_of_which_nobody_says_that_it_may_move_stands() {
    let _alone = alone();
    let mut launched = Launched::start(&RUN);
    let mut viewer = JointViewer::join(&launched.when_started());
    viewer.until_fast();
    launched.signal(Signal::STOP);
    let stood = viewer.until_it_stands();
    viewer.sees_it_stay(&stood);
    launched.signal(Signal::CONT);
    viewer.until_fast();
    launched.signal(Signal::TERM);
    launched.finish();
}

#[test]
fn who_stops_names_the_run_where_there_are_several_and_one_that_is_there() {
    let _alone = alone();
    let mut launched = [Launched::start(&RUN), Launched::start(&RUN)];
    let runs = [launched[0].when_started(), launched[1].when_started()];
    for command in ["stop", "resume"] {
        let (code, said, _) = operate(&[command]);
        assert_eq!(code, Some(2), "{said}");
        assert!(runs.iter().all(|run| said.contains(run.id())) && said.contains("--run"), "{said}");
        let (code, said, _) = operate(&[command, "--run", "no-such-run"]);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains("there is no run no-such-run"), "{said}");
    }
    launched.iter().for_each(|launched| launched.signal(Signal::TERM));
    launched.into_iter().for_each(|launched| _ = launched.finish());
}

#[test]
fn the_run_of_another_user_is_refused_by_name() {
    if user() != 0 {
        eprintln!("only root can make what belongs to another user");
        return;
    }
    let id = format!("{:x}-stopping", std::process::id());
    let directory = coact_tests::shared_memory().join(format!("coact_{id}"));
    DirBuilder::new().mode(0o700).create(&directory).unwrap();
    std::os::unix::fs::chown(&directory, Some(12345), Some(12345)).unwrap();
    let (code, said, _) = operate(&["stop", "--run", &id]);
    std::fs::remove_dir(&directory).unwrap();
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("belongs to user 12345"), "{said}");
}

/// Who runs this test.
fn user() -> u32 {
    rustix::process::geteuid().as_raw()
}
