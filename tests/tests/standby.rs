//! A stage that has a standby may die or hang: its readers get their message in every cycle all the same.
#![allow(clippy::unwrap_used)]

use coact_run_records::{Event, FaultEvent, SupervisorEventKind};
use coact_table_edit::TableEdit;
use coact_tests::{Finished, Launched, alone, checkout, coact, left_behind};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::Path;
use std::process::Command;

/// Cycles of a busy test machine's own that may fall into one recovery, in which everybody misses some.
const OF_THE_MACHINE: u64 = 3;
/// So many cycles go without output, about, where no standby takes over.
const RECOVERY: u64 = 20;

/// The shipped table, but fields and control have a standby, and what dies is not given up.
fn with_standby(folder: &Path) -> String {
    let table = TableEdit::of(&checkout().join("rt-config")).unwrap();
    let table = table.with_standby(&["fields", "control"]).unwrap().with("restart", "intensity", 99).unwrap();
    table.write(folder).unwrap().to_str().unwrap().to_owned()
}

fn faults(finished: &Finished) -> impl Iterator<Item = &FaultEvent> {
    finished.events.iter().filter_map(|event| match event {
        Event::Fault(fault) => Some(fault),
        _ => None,
    })
}

/// When the first stage is struck, ms of the run.
const FIRST_FAULT_MS: u64 = 3000;

/// For how long in the first `ms` of a run, in which nothing was struck, control had nothing to go by, ms: where that is more than a
/// hundredth, the machine keeps stages from their cycles so often that nothing is to be seen of what a fault does.
fn without_output_before(finished: &Finished, ms: u64) -> u64 {
    let blind = finished.events.iter().filter_map(|event| match event {
        Event::Blind { from_ms, until_ms } if *from_ms < ms => Some(until_ms - from_ms),
        _ => None,
    });
    blind.sum()
}

/// Stages of which one is struck after the other, and in what ways.
const STAGES: [&str; 4] = ["fields", "control", "fields-standby", "control-standby"];
const KINDS: [&str; 4] = ["kill", "stop", "kill", "abort"];
/// How often all are struck: where the machine is late in more than half of the recoveries, nothing is to be seen of the faults in that run.
const RUNS: usize = 3;

/// A run in which each stage is struck in each way.
fn struck() -> Finished {
    let folder = tempfile::tempdir().unwrap();
    let table = with_standby(folder.path());
    let spec = |(index, (kind, stage))| {
        format!("--inject={stage}:{kind}@{}ms", FIRST_FAULT_MS as usize + 700 * index)
    };
    let pairs = KINDS.iter().flat_map(|kind| STAGES.iter().map(move |stage| (kind, stage)));
    let injections: Vec<String> = pairs.enumerate().map(spec).collect();
    let mut arguments = vec!["--pipeline", &table, "--world", "kinematic", "--duration", "16"];
    arguments.extend(injections.iter().map(String::as_str));
    let mut launched = Launched::start(&arguments);
    let run = launched.when_started();
    let finished = launched.finish();
    assert_eq!(left_behind(&run), Vec::<String>::new());
    for stage in STAGES {
        assert!(finished.count(SupervisorEventKind::Ready, stage) > KINDS.len(), "{:?}", finished.supervisor);
    }
    assert!(faults(&finished).count() >= injections.len(), "{:?}", finished.events);
    finished
}

/// Each of these recoveries takes some twenty cycles. One in which stages missed some that nobody struck was the machine's.
fn undisturbed(finished: &Finished) -> Vec<&FaultEvent> {
    let machine_in_time = |fault: &&FaultEvent| {
        let stage = coact_messages::topic::stage(&fault.process);
        let of_others = |name: &&String| coact_messages::topic::stage(name) != stage;
        !fault.survivors_missed.keys().any(|name| of_others(&name))
    };
    faults(finished).filter(machine_in_time).collect()
}

#[test]
fn whatever_happens_to_a_stage_or_its_standby_no_cycle_goes_without_output() {
    let _alone = alone();
    let struck_often = (STAGES.len() * KINDS.len()) as u64;
    let late_by_itself = |run: &Finished| without_output_before(run, FIRST_FAULT_MS);
    let is_late = |run: &Finished| late_by_itself(run) > FIRST_FAULT_MS / 100;
    let is_seen = |run: &Finished| undisturbed(run).len() as u64 > struck_often / 2;
    let mut runs = (0..RUNS).map(|_| struck());
    let found = runs.find(|run| is_late(run) || is_seen(run));
    let finished = found.expect("a run in which the machine was in time in half of the recoveries");
    if is_late(&finished) {
        println!("not judged: {} ms without output before anything was struck", late_by_itself(&finished));
        return;
    }
    let undisturbed = undisturbed(&finished);
    let of_the_other = |fault: &&FaultEvent| {
        let other = match fault.process.strip_suffix("-standby") {
            Some(stage) => stage.to_owned(),
            None => format!("{}-standby", fault.process),
        };
        missed(fault, &other)
    };
    let many: Vec<_> = undisturbed.iter().filter(|fault| of_the_other(fault) > OF_THE_MACHINE).collect();
    let as_without = undisturbed.iter().any(|fault| of_the_other(fault) >= RECOVERY);
    assert!(many.len() <= 1 && !as_without, "{many:?}");
    let summary = finished.summary();
    let (missing, most) = (summary.command_outage.without_output, OF_THE_MACHINE * struck_often);
    // Each time that the machine was late it was so by its longest at most, and the cycles of that time are missing.
    let machine = summary.environment.machine.unwrap_or_default();
    let late = machine.late * machine.longest_ns.div_ceil(coact_period::PERIOD_NS);
    // Nobody struck perception: what it missed the machine withheld, and without a percept there is no command in time.
    let without_percept = summary.processes["perception"].outage.without_output;
    println!("without a command {missing}, without a percept {without_percept}, the machine late {late}");
    assert!(
        missing <= most + late + without_percept,
        "{missing} cycles without a command, {without_percept} without a percept, {late} of the machine's at most\n{}",
        finished.stderr
    );
}

fn missed(fault: &FaultEvent, process: &str) -> u64 {
    fault.survivors_missed.get(process).copied().unwrap_or(0)
}

/// The person means what she may not do yet, again and again, at times of her own: what the robot decides does not hang on a
/// handover, in which one tick of the machine's is a second later on, nor on noise, as for the open hand, which does not tell what it asks for.
const SCENARIO: &str = r#"
[start]
achieved = ["wheel on the person's side", "wheel on the robot's side", "nut on the person's side", "nut on the robot's side"]

[[action]]
at = 3.0
chain = "insert"
kind = "column 4"
gives_up = 1.0

[[action]]
at = 10.0
chain = "insert"
kind = "column 2"
gives_up = 1.0

[[action]]
at = 17.0
chain = "insert"
kind = "column 4"
gives_up = 1.0

[[action]]
at = 24.0
chain = "insert"
kind = "column 2"
gives_up = 1.0
"#;
/// What follows from it: a request for the first column, and a correction and another request for each of the four actions.
const DECISIONS: usize = 9;

/// Kills of fields and control at random instants of a run.
fn kills(seed: u64) -> Vec<String> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut at_ms = 2500;
    let mut kill = |_| {
        at_ms += random.random_range(500..1500);
        let stage = if random.random_bool(0.5) { "fields" } else { "control" };
        format!("--inject={stage}:kill@{at_ms}ms")
    };
    (0..24).map(&mut kill).collect()
}

/// What the robot decides in a run with these faults, in order, and when, ms.
fn decisions(folder: &Path, table: &str, injections: &[String]) -> Vec<(u64, String)> {
    let scenario = folder.join("scenario.toml");
    std::fs::write(&scenario, SCENARIO).unwrap();
    let partner = format!("script:{}", scenario.display());
    let mut arguments = vec!["--pipeline", table, "--world", "kinematic", "--duration", "30"];
    arguments.extend(["--partner", &partner, "--seed", "1"]);
    arguments.extend(injections.iter().map(String::as_str));
    let finished = Launched::start(&arguments).finish();
    let killed = faults(&finished).filter(|fault| fault.fault == "kill").count();
    assert!(killed >= injections.len().min(15), "{killed} kills: {:?}", finished.supervisor);
    let decision = |event: &Event| match event {
        Event::Decision { at_ms, action } => Some((*at_ms, action.clone())),
        _ => None,
    };
    finished.events.iter().filter_map(decision).collect()
}

#[test]
fn kills_of_fields_and_control_change_no_decision() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let table = with_standby(folder.path());
    let of_run = |injections: &[String]| decisions(folder.path(), &table, injections);
    let (undisturbed, killed) = (of_run(&[]), of_run(&kills(1)));
    let names = |decided: &[(u64, String)]| decided.iter().map(|(_, name)| name.clone()).collect::<Vec<_>>();
    let onsets: Vec<_> =
        undisturbed.iter().zip(&killed).map(|(one, other)| one.0.abs_diff(other.0)).collect();
    println!("onsets apart by, ms: {onsets:?}");
    assert_eq!(undisturbed.len(), DECISIONS, "{undisturbed:?}");
    assert_eq!(
        names(&undisturbed),
        names(&killed),
        "onsets apart by, ms: {onsets:?}\nundisturbed: {undisturbed:?}\nwith kills: {killed:?}"
    );
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
