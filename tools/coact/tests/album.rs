//! The album: drawn after a run, named in its report, drawn once more, and refused where there is none.
#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

fn coact(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_coact")).args(arguments).output().unwrap()
}

#[test]
fn a_run_leaves_its_album_and_it_can_be_drawn_once_more() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().to_str().unwrap();
    let launch = ["launch", "--lockstep", "--world", "kinematic", "--duration", "5", "--report", report];
    let said = String::from_utf8(coact(&launch).stdout).unwrap();
    let sheet = folder.path().join("plots/assembly.png");
    assert!(said.contains(&format!("album         {}", sheet.display())), "{said}");
    let drawn = std::fs::read(&sheet).unwrap();
    std::fs::remove_file(&sheet).unwrap();
    let again = coact(&["album", report]);
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
    assert_eq!(String::from_utf8(again.stdout).unwrap().trim_end(), sheet.display().to_string());
    assert!(std::fs::read(&sheet).unwrap() == drawn, "the same album makes the same picture");
}

#[test]
fn a_folder_without_an_album_is_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let output = coact(&["album", folder.path().to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.lines().count() == 1 && said.contains("expected the report directory of a run"), "{said}");
    assert!(!folder.path().join("plots").exists());
}

#[test]
fn an_album_of_another_task_is_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().to_str().unwrap();
    coact(&["launch", "--lockstep", "--world", "kinematic", "--duration", "1", "--report", report]);
    let task = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/tasks/electronics-box.toml");
    let output = coact(&["album", report, "--task", task]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.lines().count() == 1 && said.contains("name the task of the run"), "{said}");
}
