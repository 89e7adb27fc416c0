//! A stage that has a standby may die or hang: its readers get their message in every cycle all the same.
#![allow(clippy::unwrap_used)]

use coact_run_records::{Event, FaultEvent, SupervisorEventKind};
use coact_tests::{Finished, Launched, checkout, coact, left_behind};
use std::path::Path;
use std::process::Command;

/// Cycles of a busy test machine's own that may fall into one recovery, in which everybody misses some.
const OF_THE_MACHINE: u64 = 3;

/// A copy of the shipped table and verdicts, in which fields and control have a standby. Returns the table.
fn with_standby(folder: &Path) -> String {
    let shipped = checkout().join("rt-config");
    std::fs::copy(shipped.join("verdict.toml"), folder.join("verdict.toml")).unwrap();
    let table = std::fs::read_to_string(shipped.join("pipeline.toml")).unwrap();
    assert_eq!(table.matches("\nstandby = false").count(), 2);
    // What dies is not given up in this test.
    let table =
        table.replace("\nstandby = false", "\nstandby = true").replace("intensity = 5 ", "intensity = 99 ");
    let file = folder.join("pipeline.toml");
    std::fs::write(&file, table).unwrap();
    file.to_str().unwrap().to_owned()
}

fn faults(finished: &Finished) -> impl Iterator<Item = &FaultEvent> {
    finished.events.iter().filter_map(|event| match event {
        Event::Fault(fault) => Some(fault),
        _ => None,
    })
}

#[test]
fn whatever_happens_to_a_stage_or_its_standby_no_cycle_goes_without_output() {
    let folder = tempfile::tempdir().unwrap();
    let table = with_standby(folder.path());
    let stages = ["fields", "control", "fields-standby", "control-standby"];
    let kinds = ["kill", "stop", "kill", "abort"];
    let spec = |(index, (kind, stage))| format!("--inject={stage}:{kind}@{}ms", 3000 + 700 * index);
    let pairs = kinds.iter().flat_map(|kind| stages.iter().map(move |stage| (kind, stage)));
    let injections: Vec<String> = pairs.enumerate().map(spec).collect();
    let mut arguments = vec!["--pipeline", &table, "--world", "kinematic", "--duration", "16"];
    arguments.extend(injections.iter().map(String::as_str));
    let launched = Launched::start(&arguments);
    let run = launched.when_started();
    let finished = launched.finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    for stage in stages {
        assert!(finished.count(SupervisorEventKind::Ready, stage) > kinds.len(), "{:?}", finished.supervisor);
    }
    assert!(faults(&finished).count() >= injections.len(), "{:?}", finished.events);
    // Each of these recoveries takes some twenty cycles. One in which the world missed some as well was the machine's.
    let undisturbed: Vec<_> = faults(&finished).filter(|fault| missed(fault, "world") == 0).collect();
    assert!(undisturbed.len() > injections.len() / 2, "{:?}", finished.events);
    for fault in undisturbed {
        let other = match fault.process.strip_suffix("-standby") {
            Some(stage) => stage.to_owned(),
            None => format!("{}-standby", fault.process),
        };
        assert!(missed(fault, &other) <= OF_THE_MACHINE, "{fault:?}");
    }
    let summary = finished.summary();
    let (missing, most) = (summary.command_outage.without_output, OF_THE_MACHINE * injections.len() as u64);
    let late = summary.environment.machine.map_or(0, |machine| machine.late);
    assert!(
        missing <= most + 2 * late,
        "{missing} cycles without a command, {late} late\n{}",
        finished.stderr
    );
}

fn missed(fault: &FaultEvent, process: &str) -> u64 {
    fault.survivors_missed.get(process).copied().unwrap_or(0)
}

#[test]
fn a_stage_that_can_have_no_standby_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let table = with_standby(folder.path());
    let text = std::fs::read_to_string(&table).unwrap();
    std::fs::write(&table, text.replace("trigger = \"timer\"", "trigger = \"timer\"\nstandby = true"))
        .unwrap();
    let refused = Command::new(coact())
        .args(["launch", "--pipeline", &table, "--duration", "1"])
        .current_dir(checkout())
        .output()
        .unwrap();
    let message = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(
        message.contains("process world: standby = true") && message.contains("fields and control"),
        "{message}"
    );
}
