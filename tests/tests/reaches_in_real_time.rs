//! Recorded reaches through real processes: the decisions are those of lockstep.
#![allow(clippy::unwrap_used)]

use coact_run_records::Summary;
use coact_tests::{checkout, coact, shared_memory};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Output};

/// Joints as the columns name them, and where they are from the wrist when the hand is closed, pixels: along and across
/// the way, and how far across for each pixel of opening.
const JOINTS: [(&str, [f64; 3]); 9] = [
    ("RShoulder", [-56.0, 25.0, 0.0]),
    ("RElbow", [-32.0, 0.0, 0.0]),
    ("RWrist", [0.0, 0.0, 0.0]),
    ("RPalmBase", [2.5, 2.5, 0.0]),
    ("RThumb4FingerTip", [16.0, 2.5, 0.5]),
    ("RIndex1Knuckles", [11.0, 2.5, 0.0]),
    ("RIndex4FingerTip", [19.0, -2.5, -0.5]),
    ("RMiddle4FingerTip", [20.0, -2.5, -0.5]),
    ("RPinky1Knuckles", [10.0, -5.0, 0.0]),
];

/// A made-up person's recordings: the larger the object, the wider the hand during the movement. The wrist follows a
/// minimum-jerk movement.
fn recordings() -> String {
    let mut text = "participant,size,trial,t_rel_onset_s,mt_s,rtg".to_owned();
    JOINTS.iter().for_each(|(name, _)| write!(text, ",{name}.x,{name}.y,{name}.p").unwrap());
    for (trial, (size, opening)) in [("S", 8.0), ("L", 16.0), ("L", 15.5), ("S", 8.5)].iter().enumerate() {
        for frame in 0..90 {
            let (time, movement_time) = (f64::from(frame) / 60.0 - 0.45, 0.58);
            let fraction = ((time + 0.05) / (movement_time + 0.05)).clamp(0.0, 1.0);
            let way = 55.0 * fraction * fraction * fraction * (10.0 + fraction * (6.0 * fraction - 15.0));
            let reaching = u8::from((0.0..=movement_time).contains(&time));
            write!(text, "\n7,{size},{},{time:.4},{movement_time},{reaching}", trial + 1).unwrap();
            for (_, [ahead, aside, open]) in JOINTS {
                let along = way + ahead;
                let across = aside + open * opening * (fraction / 0.7).min(1.0);
                let (x, y) = (110.0 + 0.6 * along - 0.8 * across, 100.0 + 0.8 * along + 0.6 * across);
                write!(text, ",{x:.2},{y:.2},0.8").unwrap();
            }
        }
    }
    text + "\n"
}

fn reaches(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(coact());
    command.arg("reaches").arg(folder).args(["--model", "rt-config/perception/preshape.toml"]);
    command.args(["--task", "rt-config/tasks/two-objects.toml", "--json"]).args(arguments);
    command.current_dir(checkout()).output().unwrap()
}

/// The one report that was printed.
fn report(output: &Output) -> Value {
    let mut reports: Vec<Value> = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(&output.stderr)));
    reports.pop().unwrap()
}

fn decided(report: &Value) -> Vec<&Value> {
    report["reaches"].as_array().unwrap().iter().map(|reach| &reach["decision"]["width"]).collect()
}

#[test]
fn in_real_time_it_decides_as_in_lockstep() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p7.csv"), recordings()).unwrap();
    let lockstep = report(&reaches(folder.path(), &[]));
    assert_eq!(decided(&lockstep).len(), 4);
    assert!(decided(&lockstep).iter().any(|width| !width.is_null()), "{lockstep}");
    let reports = folder.path().join("reports");
    let realtime = report(&reaches(folder.path(), &["--realtime", "--report", reports.to_str().unwrap()]));
    assert_eq!(decided(&realtime), decided(&lockstep));
    let fared = &realtime["real_time"][0];
    assert!(fared["cycles"].as_u64().unwrap() > 10_000, "four reaches take some ten seconds: {fared}");
    assert!(fared["frames_seen"].as_u64().unwrap() > 1_000, "{fared}");
    let summary = Summary::read(&reports.join("two-objects/p7")).unwrap();
    assert_eq!(summary.anticipation.actions, 4, "the monitor knows the labels");
    let left = std::fs::read_dir(shared_memory()).unwrap().map(|entry| entry.unwrap().path());
    let of_ours = |path: &Path| {
        let text = std::fs::read_to_string(path.join("run.json")).unwrap_or_default();
        text.contains(reports.to_str().unwrap())
    };
    assert!(!left.into_iter().any(|path| of_ours(&path)), "the run is gone");
}

#[test]
fn what_is_asked_for_in_vain_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p7.csv"), recordings()).unwrap();
    for (arguments, said) in [
        (&["--person", "8"] as &[&str], "--person 8"),
        (&["--realtime", "--order", "file"], "--order file"),
        (&["--report", "somewhere"], "--realtime"),
    ] {
        let output = reaches(folder.path(), arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(said), "{error}");
    }
    let broken = recordings().replacen(",0.8\n", ",much\n", 1);
    std::fs::write(folder.path().join("p7.csv"), broken).unwrap();
    let output = reaches(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("p7.csv:2"), "{output:?}");
}
