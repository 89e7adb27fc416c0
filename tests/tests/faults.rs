//! Whatever dies, the set goes on: no subgoal is lost, and the report has a line for it.
#![allow(clippy::unwrap_used)]

use coact_pipeline::Pipeline;
use coact_run_records::{Event, SupervisorEvent, SupervisorEventKind};
use coact_tests::{Finished, Launched, checkout, coact, left_behind, wait_for};
use std::process::{Command, Output};

#[test]
fn each_process_is_killed_once_and_the_assembly_is_finished() {
    let pipeline = Pipeline::load(&checkout().join("rt-config/pipeline.toml")).unwrap();
    let always = pipeline.processes.iter().filter(|entry| !entry.on_request);
    let names: Vec<String> = always.map(|entry| entry.name.clone()).collect();
    let kill = |(index, name): (usize, &String)| format!("--inject={name}:kill@{}s", 4 + 5 * index);
    let kills: Vec<String> = names.iter().enumerate().map(kill).collect();
    let mut arguments = vec!["--world", "kinematic"];
    arguments.extend(kills.iter().map(String::as_str));
    let mut launched = Launched::start(&arguments);
    let run = launched.when_started();
    let finished = launched.finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    let summary = finished.summary();
    assert_eq!(summary.task.achieved, summary.task.subgoals, "{}", finished.stderr);
    let forgotten = finished.events.iter().filter(|event| matches!(event, Event::Forgotten { .. })).count();
    assert_eq!(forgotten, 0, "{:?}", finished.events);
    for name in &names {
        assert_eq!(
            killed(&finished, SupervisorEventKind::Died, name),
            1,
            "{name}\n{:?}",
            finished.supervisor
        );
        assert_eq!(
            killed(&finished, SupervisorEventKind::Ready, name),
            1,
            "{name}\n{:?}",
            finished.supervisor
        );
        let fault =
            summary.faults.iter().find(|fault| fault.process == *name && fault.fault == "kill").unwrap();
        assert!(fault.detected_ms.is_some() && fault.recovered_ms.is_some(), "{fault:?}");
    }
    let kills = summary.faults.iter().filter(|fault| fault.fault == "kill").count();
    assert_eq!(kills, names.len(), "{:?}", summary.faults);
}

#[test]
fn faults_are_injected_into_a_running_set_from_the_command_line() {
    let mut launched = Launched::start(&["--duration", "12", "--world", "kinematic"]);
    let run = launched.when_started();
    let id = run.id();
    assert!(inject(&["fields", "kill", "--run", id]).status.success());
    wait_for("the replacement of fields", || run.ready("fields", 1).unwrap());
    assert!(inject(&["perception", "crash-on-start", "--run", id]).status.success());
    wait_for("the second replacement of perception", || run.ready("perception", 2).unwrap());
    assert!(inject(&["control", "stop", "--run", id]).status.success());
    wait_for("the replacement of control", || run.ready("control", 1).unwrap());
    let unknown = inject(&["wheels", "kill", "--run", id]);
    assert_eq!(unknown.status.code(), Some(2));
    let message = String::from_utf8(unknown.stderr).unwrap();
    for name in ["wheels", "world", "perception", "fields", "control", "monitor", "voice"] {
        assert!(message.contains(name), "{name} is not in: {message}");
    }
    let finished = launched.finish();
    assert!(finished.cycles("fields") > 6000, "{}", finished.stderr);
    let found_hung = finished.supervisor.iter().any(|event| {
        event.process == "control" && event.reason.as_deref().is_some_and(|reason| reason.starts_with("hung"))
    });
    assert!(found_hung, "{:?}", finished.supervisor);
}

#[test]
fn a_replacement_resumes_from_its_predecessors_checkpoint() {
    let mut launched =
        Launched::start(&["--duration", "8", "--world", "kinematic", "--inject=fields:kill@5s"]);
    let run = launched.when_started();
    let ready = wait_for("the replacement of fields", || run.ready("fields", 1).unwrap());
    assert!(ready.resumed);
    launched.finish();
}

#[test]
fn a_run_that_does_not_exist_is_refused() {
    let refused = inject(&["fields", "kill", "--run", "no-such-run"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8(refused.stderr).unwrap().contains("no-such-run"));
}

/// Events of `kind` that the injected kill of `name` led to: a shared machine that stalls a stage for more than
/// 100 ms adds deaths by hanging, which are not this test's.
fn killed(finished: &Finished, kind: SupervisorEventKind, name: &str) -> usize {
    let of_the_kill = |event: &&SupervisorEvent| {
        event.event == kind && event.process == name && event.fault.as_deref() == Some("kill")
    };
    finished.supervisor.iter().filter(of_the_kill).count()
}

fn inject(arguments: &[&str]) -> Output {
    Command::new(coact()).arg("inject").args(arguments).output().unwrap()
}
