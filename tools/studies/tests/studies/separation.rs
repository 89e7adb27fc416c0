//! `coact separation`: what it prints and how it refuses.
#![allow(clippy::unwrap_used)]

use crate::program::coact;
use std::fmt::Write as _;

/// A folder with motion capture of both arms, three seconds of it; the left one was lost after one.
fn folder() -> tempfile::TempDir {
    let mut text = String::from("t_s");
    for body in ["shoulder", "elbow", "hand"] {
        for side in ["left", "right"] {
            write!(text, ",{side}_{body}.x_mm,{side}_{body}.y_mm,{side}_{body}.z_mm").unwrap();
        }
    }
    for frame in 0..300 {
        let time = f64::from(frame) * 0.01;
        write!(text, "\n{time:.2}").unwrap();
        for joint in 0..3 {
            let ahead = f64::from(joint) * (100.0 + 50.0 * (2.0 * time).sin());
            let left = if frame < 100 { format!("-200,{ahead:.1},500") } else { ",,".to_owned() };
            write!(text, ",{left},200,{ahead:.1},{}", 500 - 100 * joint).unwrap();
        }
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("0.csv"), text + "\n").unwrap();
    folder
}

#[test]
fn every_arm_that_was_seen_is_met_and_counted() {
    let folder = folder();
    let output = coact(&["separation", folder.path().to_str().unwrap(), "--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("left out: ") && said.contains("the left arm"), "{said}");
    let separation: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(separation["total"]["encounters"], 1);
    let one = &separation["encounters"][0];
    assert_eq!((&one["arm"], &one["seed"]), (&"right".into(), &1.into()));
    assert!(one["separation"]["ticks"].as_u64().unwrap() > 2_900, "{one}");
    let output = coact(&["separation", folder.path().to_str().unwrap(), "--encounters", "2"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("2 encounters") && said.contains("together"), "{said}");
}

#[test]
fn a_folder_without_recordings_is_one_error() {
    let empty = tempfile::tempdir().unwrap();
    for folder in [empty.path().to_str().unwrap(), "/nowhere"] {
        let output = coact(&["separation", folder]);
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.lines().count() == 1 && said.contains(folder), "{said}");
    }
}
