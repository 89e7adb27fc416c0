//! Every line is a way from exactly its beginning to exactly its end, or an error names file and line.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use coact_recordings::{ArmSide, RecordingError, Way, WayKind, read_ways, ways_text};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn straight(kind: WayKind) -> Way {
    let point = |index: usize| [index as f64 / (Way::POINTS - 1) as f64, 0.0, 0.0];
    Way {
        kind,
        recording: "Stacking/0".to_owned(),
        hand: ArmSide::Left,
        frames: [120, 240],
        distance: 0.25,
        duration: 1.2,
        points: std::array::from_fn(point)
            .map(|point: [f64; 3]| point.map(|value| (value * 1e4).round() / 1e4)),
    }
}

fn file(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("carries.csv");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

#[test]
fn what_is_written_is_read_again() {
    let ways = WayKind::ALL.map(straight).to_vec();
    let (_folder, path) = file(&ways_text(&ways));
    assert_eq!(read_ways(&path).unwrap(), ways);
}

#[test]
fn shipped_ways_are_of_every_kind() {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/carries/carries.csv");
    let ways = read_ways(&shipped).unwrap();
    for kind in WayKind::ALL {
        let count = ways.iter().filter(|way| way.kind == kind).count();
        assert!(count >= 4, "{count} ways of the kind {}", kind.name());
    }
}

#[test]
fn broken_lines_are_refused_with_file_and_line() {
    let good = ways_text(&WayKind::ALL.map(straight));
    let spoils: [(&str, &str, &str); 8] = [
        ("\ngive,", "\nthrow,", "kind: expected carry, give or withdraw, found \"throw\""),
        ("\ngive,Stacking/0,left", "\ngive,Stacking/0,both", "hand: expected left or right"),
        (
            "\ngive,Stacking/0,left,120,240",
            "\ngive,Stacking/0,left,120,120",
            "last_frame: expected more than 120",
        ),
        (
            "\ngive,Stacking/0,left,120",
            "\ngive,Stacking/0,left,first",
            "first_frame: expected a whole number",
        ),
        (
            "\ngive,Stacking/0,left,120,240,0.2500",
            "\ngive,Stacking/0,left,120,240,NaN",
            "distance_m: expected a number from 0.01 to 2",
        ),
        ("1.20,0.0000,", "1.20,0.1000,", "point 0: expected 0, 0, 0"),
        ("1.0000,0.0000,0.0000\n", "1.0000,0.0000,0.0010\n", "point 32: expected 1, 0, 0"),
        ("1.0000,0.0000,0.0000\n", "1.0000,0.0000\n", "as many comma-separated fields as the header has"),
    ];
    for (found, put, expected) in spoils {
        // In the second way, which is line 3.
        let (before, rest) = good.split_at(good.find("\ngive").unwrap());
        assert!(rest.contains(found), "{found}");
        let (_folder, path) = file(&format!("{before}{}", rest.replacen(found, put, 1)));
        let error = read_ways(&path).unwrap_err();
        assert!(matches!(error, RecordingError::Line { line: 3, .. }), "{error}");
        let message = error.to_string();
        assert!(message.contains("carries.csv:3: ") && message.contains(expected), "{message}");
    }
}

#[test]
fn a_file_without_ways_or_columns_is_refused() {
    let good = ways_text(&[straight(WayKind::Carry)]);
    let (_folder, path) = file(good.lines().next().unwrap());
    assert!(read_ways(&path).unwrap_err().to_string().contains("carries.csv:2: expected a way in each line"));
    let (_folder, path) = file(&good.replace("aside.7", "beside.7"));
    assert!(
        read_ways(&path).unwrap_err().to_string().contains("carries.csv:1: column \"aside.7\" is missing")
    );
    let absent = read_ways(Path::new("no/such/carries.csv")).unwrap_err().to_string();
    assert!(absent.contains("no/such/carries.csv"), "{absent}");
}
