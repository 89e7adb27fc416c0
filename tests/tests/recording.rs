//! A run that was recorded is computed again to the bit; what is changed in the recording is named; and whatever happens to the
//! recorder, the run goes on and its recording can be read.
#![allow(clippy::unwrap_used)]

use coact_run_recording::{Recorded, Recording, RecordingWriter};
use coact_tests::{Launched, checkout, coact, wait_for};
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

/// Seconds that are recorded: the first decision and the first movement.
const SPAN: &str = "6";

fn replay(recording: &Path) -> Output {
    let program = coact().with_file_name("coact-studies");
    assert!(program.is_file(), "{} is missing: cargo build --workspace --bins", program.display());
    Command::new(program).args(["replay", "--json"]).arg(recording).current_dir(checkout()).output().unwrap()
}

/// Exit status and report of a replay that compares.
fn replayed(recording: &Path) -> (Option<i32>, Value) {
    let output = replay(recording);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{said}")))
}

/// The same recording with other messages.
fn rewrite(from: &Path, to: &Path, mut change: impl FnMut(&mut Recorded)) {
    let mut recording = Recording::open(from).unwrap();
    let mut writer = RecordingWriter::create(to, recording.origin()).unwrap();
    while let Some(mut message) = recording.next_message().unwrap() {
        change(&mut message);
        writer.message(&message).unwrap();
    }
    writer.finish(recording.lost().unwrap()).unwrap();
}

/// Most of the cycles of a second, however late the machine is.
fn expect_many(report: &Value, seconds: u64) {
    let compared = |stage: &str| report[stage]["compared"].as_u64().unwrap();
    assert!(compared("percepts") > 500 * seconds && compared("frames") > 10 * seconds, "{report}");
}

#[test]
fn a_recorded_run_is_computed_again_to_the_bit_and_a_byte_that_is_changed_is_named() {
    let launched = Launched::start(&["--world", "kinematic", "--duration", SPAN, "--record"]);
    let (folder, report) = (launched.folder(), launched.report());
    launched.finish();
    let whole = report.join("run.mcap");
    let (code, report) = replayed(&whole);
    assert_eq!(
        (code, &report["equal"], &report["truncated"]),
        (Some(0), &true.into(), &false.into()),
        "{report}"
    );
    assert!(report["same_code"].as_bool().unwrap() && report["lost"].is_object(), "{report}");
    expect_many(&report, 6);

    let changed = folder.path().join("changed.mcap");
    let mut cycle = 0;
    rewrite(&whole, &changed, |message| {
        if let Recorded::Percept(percept) = message
            && cycle == 0
            && percept.header.cycle > 3000
        {
            cycle = percept.header.cycle;
            bytemuck::bytes_of_mut(&mut percept.workspace[1].position[3][2])[5] ^= 1;
        }
    });
    let (code, report) = replayed(&changed);
    assert_eq!(
        (code, &report["equal"], &report["percepts"]["differing"]),
        (Some(1), &false.into(), &1.into())
    );
    let found = &report["percepts"]["first_difference"];
    assert_eq!((&found["cycle"], &found["field"]), (&cycle.into(), &"workspace[1].position[3][2]".into()));
    assert!(report["frames"]["first_difference"].is_null(), "{report}");

    // Cut off where it may be: in the middle of a chunk, most probably.
    let bytes = std::fs::read(&whole).unwrap();
    let cut = folder.path().join("cut.mcap");
    std::fs::write(&cut, &bytes[..bytes.len() / 2]).unwrap();
    let (code, report) = replayed(&cut);
    assert_eq!(
        (code, &report["truncated"], &report["lost"]),
        (Some(0), &true.into(), &Value::Null),
        "{report}"
    );
    expect_many(&report, 1);
    for (bytes, expected) in
        [(&bytes[..10], "does not say"), (b"no recording", "is no MCAP file"), (b"", "does not say")]
    {
        std::fs::write(&cut, bytes).unwrap();
        let output = replay(&cut);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains(expected), "{said}");
    }
}

#[test]
fn a_killed_recorder_leaves_a_recording_that_can_be_read_and_its_successor_another() {
    let mut launched = Launched::start(&["--world", "kinematic", "--duration", SPAN, "--record"]);
    let (_folder, report, run) = (launched.folder(), launched.report(), launched.when_started());
    std::thread::sleep(Duration::from_millis(2500));
    let pid = run.ready("recorder", 0).unwrap().unwrap().pid;
    kill_process(Pid::from_raw(pid as i32).unwrap(), Signal::KILL).unwrap();
    wait_for("the recorder's replacement", || run.ready("recorder", 1).unwrap());
    let finished = launched.finish();
    finished.only_died(&["recorder"]);
    assert!(matches!(finished.code, Some(0 | 1)), "{}", finished.stderr);
    let (code, first) = replayed(&report.join("run.mcap"));
    assert_eq!(
        (code, &first["truncated"], &first["equal"]),
        (Some(0), &true.into(), &true.into()),
        "{first}"
    );
    expect_many(&first, 1);
    let (code, second) = replayed(&report.join("run-2.mcap"));
    assert_eq!(
        (code, &second["truncated"], &second["equal"]),
        (Some(0), &false.into(), &true.into()),
        "{second}"
    );
    expect_many(&second, 1);
    assert!(second["percepts"]["resumed"].as_u64().unwrap() >= 1, "it has no beginning: {second}");
}
