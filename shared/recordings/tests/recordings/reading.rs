//! Every row becomes part of a reach, or an error names file and line.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use coact_recordings::{JOINTS, RecordingError, Size, read_file, read_folder};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn header() -> String {
    let joints: Vec<String> = JOINTS.iter().map(|joint| format!("{joint}.x,{joint}.y,{joint}.p")).collect();
    format!("participant,size,trial,t_rel_onset_s,mt_s,rtg,{}", joints.join(","))
}

fn row(size: &str, trial: u32, time: f64) -> String {
    let joints: Vec<String> =
        (0..9).map(|joint| format!("{}.5,{}.25,0.9", 100 + joint, 50 + joint)).collect();
    format!("7,{size},{trial},{time},0.5,1,{}", joints.join(","))
}

fn file(lines: &[String]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p7.csv");
    std::fs::write(&path, lines.join("\n") + "\n").unwrap();
    (folder, path)
}

/// Line and message of the error that a file with these lines makes.
fn refusal(lines: &[String]) -> (u64, String) {
    let (_folder, path) = file(lines);
    match read_file(&path).unwrap_err() {
        error @ RecordingError::Line { line, .. } => (line, error.to_string()),
        other => panic!("expected a line to be refused, found: {other}"),
    }
}

#[test]
fn every_row_becomes_a_frame_of_its_reach() {
    let rows = [row("S", 1, -0.1), row("S", 1, 0.0), row("S", 2, 0.0), row("L", 1, 0.0), row("L", 1, 0.1)];
    let lines: Vec<String> = std::iter::once(header()).chain(rows).collect();
    let (folder, _path) = file(&lines);

    let reaches = read_folder(folder.path()).unwrap();

    let shape: Vec<_> = reaches.iter().map(|reach| (reach.size, reach.trial, reach.frames.len())).collect();
    assert_eq!(shape, [(Size::Small, 1, 2), (Size::Small, 2, 1), (Size::Large, 1, 2)]);
    let wrist = reaches[0].frames[1].joints[2];
    assert_eq!((wrist.x, wrist.y, wrist.confidence), (102.5, 52.25, 0.9));
    assert_eq!((reaches[0].participant, reaches[0].movement_time), (7, 0.5));
}

#[test]
fn a_missing_column_is_named() {
    let (_folder, path) = file(&[header().replace("RWrist.y", "wrist_y"), row("S", 1, 0.0)]);
    let error = read_file(&path).unwrap_err().to_string();
    assert!(error.contains("p7.csv:1") && error.contains("RWrist.y"), "{error}");
}

#[test]
fn a_field_that_is_no_number_is_refused_with_its_line() {
    for bad in ["NaN", "inf", "", "12,5x"] {
        let (line, message) = refusal(&[header(), row("S", 1, 0.0), row("S", 1, 0.1).replace("103.5", bad)]);
        assert_eq!(line, 3, "{bad}: {message}");
    }
    let (line, message) = refusal(&[header(), row("S", 1, 0.0).replace(",0.5,1,", ",nan,1,")]);
    assert!(line == 2 && message.contains("mt_s"), "{message}");
}

#[test]
fn a_broken_line_is_refused() {
    let whole = row("S", 1, 0.1);
    let (line, _) = refusal(&[header(), row("S", 1, 0.0), whole[..whole.len() / 2].to_owned()]);
    assert_eq!(line, 3);
}

#[test]
fn unknown_sizes_and_confidences_beyond_one_are_refused() {
    let (line, message) = refusal(&[header(), row("XL", 1, 0.0)]);
    assert!(line == 2 && message.contains("S, M or L"), "{message}");
    let (_, message) = refusal(&[header(), row("S", 1, 0.0).replacen("0.9", "9.0", 1)]);
    assert!(message.contains("RShoulder.p"), "{message}");
}

#[test]
fn frames_out_of_order_and_scattered_reaches_are_refused() {
    let (line, _) = refusal(&[header(), row("S", 1, 0.1), row("S", 1, 0.1)]);
    assert_eq!(line, 3);
    let (line, message) = refusal(&[header(), row("S", 1, 0.0), row("M", 1, 0.0), row("S", 1, 0.2)]);
    assert!(line == 4 && message.contains("earlier lines"), "{message}");
}

#[test]
fn a_reach_has_one_movement_time() {
    let (line, message) =
        refusal(&[header(), row("S", 1, 0.0), row("S", 1, 0.1).replace(",0.5,1,", ",0.6,1,")]);
    assert!(line == 3 && message.contains("mt_s"), "{message}");
}

#[test]
fn a_folder_without_recordings_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(read_folder(folder.path()), Err(RecordingError::Empty { .. })));
    assert!(matches!(read_folder(&folder.path().join("absent")), Err(RecordingError::Io { .. })));
}

/// Writes what `source` yields to `path`, compressed.
fn compress(mut source: impl Read, path: &Path) {
    let mut encoder = GzEncoder::new(std::fs::File::create(path).unwrap(), Compression::fast());
    std::io::copy(&mut source, &mut encoder).unwrap();
    encoder.finish().unwrap().flush().unwrap();
}

#[test]
fn a_compressed_file_is_read_as_the_plain_one() {
    let rows = [header(), row("S", 1, 0.0), row("M", 1, 0.0), row("M", 1, 0.1)];
    let (plain, _path) = file(&rows);
    let folder = tempfile::tempdir().unwrap();
    compress((rows.join("\n") + "\n").as_bytes(), &folder.path().join("p7.csv.gz"));
    std::fs::write(folder.path().join("LICENSE"), "no recording").unwrap();
    assert_eq!(read_folder(folder.path()).unwrap(), read_folder(plain.path()).unwrap());
}

#[test]
fn a_mistake_in_a_compressed_file_is_named_with_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p7.csv.gz");
    let lines = [header(), row("S", 1, 0.0), row("XL", 1, 0.1)];
    compress(lines.join("\n").as_bytes(), &path);
    let message = read_file(&path).unwrap_err().to_string();
    assert!(message.contains("p7.csv.gz:3: size: expected S, M or L"), "{message}");
}

#[test]
fn a_broken_archive_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p7.csv.gz");
    compress(header().as_bytes(), &path);
    let whole = std::fs::read(&path).unwrap();
    for broken in [&whole[..whole.len() / 2], &b"participant,size"[..]] {
        std::fs::write(&path, broken).unwrap();
        let error = read_file(&path).unwrap_err();
        assert!(
            matches!(&error, RecordingError::Io { .. }) && error.to_string().contains("p7.csv.gz"),
            "{error}"
        );
    }
}

#[test]
fn an_archive_that_would_fill_the_memory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p7.csv.gz");
    compress(std::io::repeat(b' ').take(1 << 30), &path);
    assert!(matches!(read_file(&path), Err(RecordingError::TooLarge { .. })));
}

#[test]
fn a_recording_that_stands_in_the_folder_both_ways_is_refused() {
    let (folder, path) = file(&[header(), row("S", 1, 0.0)]);
    compress(std::fs::File::open(&path).unwrap(), &folder.path().join("p7.csv.gz"));
    let message = read_folder(folder.path()).unwrap_err().to_string();
    assert!(message.contains("p7.csv.gz") && message.contains("p7.csv;"), "{message}");
}
