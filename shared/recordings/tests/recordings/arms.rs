//! One arm of a file of motion capture: what was seen is kept, what was not is not made up, and errors name file and line.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use coact_recordings::{ArmRecording, ArmSide, RecordingError, arm_files};
use std::path::PathBuf;
use tempfile::TempDir;

const BODIES: [&str; 6] =
    ["left_elbow", "left_hand", "left_shoulder", "right_elbow", "right_hand", "right_shoulder"];

fn header() -> String {
    let bodies: Vec<String> =
        BODIES.iter().map(|body| format!("{body}.x_mm,{body}.y_mm,{body}.z_mm")).collect();
    format!("t_s,{}", bodies.join(","))
}

/// A frame, each body of the arm elsewhere, and in motion; what is `lost` is empty.
fn frame(index: u32, lost: Option<&str>) -> String {
    let time = 0.01 * f64::from(index);
    let body = |(place, name): (usize, &&str)| match lost {
        Some(lost) if lost == *name => ",,".to_owned(),
        _ => format!(
            "{:.1},{:.1},{}",
            100.0 * place as f64 + 50.0 * time.sin(),
            80.0 * time.cos(),
            300 + place
        ),
    };
    let bodies: Vec<String> = BODIES.iter().enumerate().map(body).collect();
    format!("{time:.2},{}", bodies.join(","))
}

fn file(lines: impl IntoIterator<Item = String>) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("0.csv");
    let lines: Vec<String> = std::iter::once(header()).chain(lines).collect();
    std::fs::write(&path, lines.join("\n") + "\n").unwrap();
    (folder, path)
}

fn lengths(recording: &ArmRecording) -> Vec<usize> {
    recording.stretches.iter().map(Vec::len).collect()
}

#[test]
fn an_arm_is_read_in_metres_from_shoulder_to_wrist() {
    let (_folder, path) = file((0..300).map(|index| frame(index, None)));
    let right = ArmRecording::read(&path, ArmSide::Right).unwrap();
    assert_eq!(lengths(&right), [300]);
    assert!((right.duration - 2.99).abs() < 1e-9 && (right.seen() - 2.99).abs() < 1e-9);
    let [shoulder, elbow, wrist] = right.stretches[0][0].joints;
    assert_eq!([shoulder, elbow, wrist], [[0.5, 0.08, 0.305], [0.3, 0.08, 0.303], [0.4, 0.08, 0.304]]);
    let left = ArmRecording::read(&path, ArmSide::Left).unwrap();
    assert_eq!(left.stretches[0][0].joints[0], [0.2, 0.08, 0.302]);
}

#[test]
fn a_short_loss_is_bridged_and_a_long_one_ends_a_stretch() {
    let lost = |index: u32| match index {
        100..104 => Some("right_hand"),
        300..320 => Some("right_shoulder"),
        600..610 => Some("left_hand"),
        _ => None,
    };
    let (_folder, path) = file((0..700).map(|index| frame(index, lost(index))));
    assert_eq!(lengths(&ArmRecording::read(&path, ArmSide::Right).unwrap()), [296, 380]);
    let left = ArmRecording::read(&path, ArmSide::Left).unwrap();
    assert_eq!(lengths(&left), [600], "what comes after it is shorter than two seconds");
}

#[test]
fn a_joint_that_jumps_ends_a_stretch() {
    let swapped = |index: u32| {
        let line = frame(index, None);
        if index == 350 { line.replace(",304", ",404") } else { line }
    };
    let (_folder, path) = file((0..700).map(swapped));
    assert_eq!(lengths(&ArmRecording::read(&path, ArmSide::Right).unwrap()), [349, 348]);
    assert_eq!(lengths(&ArmRecording::read(&path, ArmSide::Left).unwrap()), [700]);
}

#[test]
fn errors_name_file_line_and_what_was_expected() {
    let refusal = |lines: Vec<String>| {
        let (_folder, path) = file(lines);
        ArmRecording::read(&path, ArmSide::Right).unwrap_err().to_string()
    };
    let number = refusal(vec![frame(0, None), frame(1, None).replace(",304", ",near")]);
    assert!(
        number.contains("0.csv:3") && number.contains("right_hand.z_mm") && number.contains("near"),
        "{number}"
    );
    let order = refusal(vec![frame(1, None), frame(1, None)]);
    assert!(order.contains("0.csv:3") && order.contains("t_s: expected more than 0.01"), "{order}");
    let (_folder, path) = file([frame(0, None)]);
    std::fs::write(&path, header().replace("right_elbow.y_mm", "elbow") + "\n").unwrap();
    let column = ArmRecording::read(&path, ArmSide::Right).unwrap_err().to_string();
    assert!(column.contains("0.csv:1") && column.contains("right_elbow.y_mm"), "{column}");
}

#[test]
fn an_arm_that_is_hardly_seen_is_told_apart_from_a_broken_file() {
    let (_folder, path) = file((0..150).map(|index| frame(index, None)));
    let error = ArmRecording::read(&path, ArmSide::Left).unwrap_err();
    assert!(error.is_unseen() && error.to_string().contains("left arm"), "{error}");
}

#[test]
fn files_are_found_in_a_folder_and_in_the_folders_in_it() {
    let (folder, path) = file([frame(0, None)]);
    std::fs::create_dir(folder.path().join("other")).unwrap();
    let other = folder.path().join("other/2.csv");
    std::fs::write(&other, "").unwrap();
    std::fs::write(folder.path().join("0.json"), "{}").unwrap();
    assert_eq!(arm_files(folder.path()).unwrap(), [path, other]);
    let empty = tempfile::tempdir().unwrap();
    assert!(matches!(arm_files(empty.path()).unwrap_err(), RecordingError::NoArms { .. }));
}
