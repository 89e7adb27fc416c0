//! Snapshots: drawn after a run, named in its report, drawn once more, and refused where there are none.
#![allow(clippy::unwrap_used)]

use crate::program::coact;

#[test]
fn snapshots_of_a_run_are_drawn_and_can_be_drawn_once_more() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().to_str().unwrap();
    let launch = ["launch", "--lockstep", "--world", "kinematic", "--duration", "5", "--report", report];
    let said = String::from_utf8(coact(&launch).stdout).unwrap();
    let sheet = folder.path().join("plots/assembly.png");
    assert!(said.contains(&format!("snapshots     {}", sheet.display())), "{said}");
    let drawn = std::fs::read(&sheet).unwrap();
    std::fs::remove_file(&sheet).unwrap();
    let again = coact(&["snapshots", report]);
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
    assert_eq!(String::from_utf8(again.stdout).unwrap().trim_end(), sheet.display().to_string());
    assert!(std::fs::read(&sheet).unwrap() == drawn, "the same snapshots make the same picture");
}

#[test]
fn a_folder_without_snapshots_is_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let output = coact(&["snapshots", folder.path().to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.lines().count() == 1 && said.contains("expected the report directory of a run"), "{said}");
    assert!(!folder.path().join("plots").exists());
}

#[test]
fn snapshots_of_another_task_are_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().to_str().unwrap();
    coact(&["launch", "--lockstep", "--world", "kinematic", "--duration", "1", "--report", report]);
    let task = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/tasks/electronics-box.toml");
    let output = coact(&["snapshots", report, "--task", task]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.lines().count() == 1 && said.contains("name the task of the run"), "{said}");
}
