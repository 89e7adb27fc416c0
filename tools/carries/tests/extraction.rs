//! What is extracted from a made-up recording is what was put in, and what cannot be used is left out.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use coact_carries::{Extraction, ExtractionError, LeftOut, extract};
use coact_recordings::{ArmSide, WayKind, read_ways, ways_text};
use std::fmt::Write as _;
use std::path::Path;
use tempfile::TempDir;

/// Where a movement of minimum jerk is at fraction `time`.
fn covered(time: f64) -> f64 {
    let time = time.clamp(0.0, 1.0);
    time * time * time * (10.0 + time * (-15.0 + 6.0 * time))
}

/// Where the left hand is in a frame, mm, while the person stands: put out and up with what it gives, 0.3 m within 1 s; then it
/// rests, and is drawn back with an arch aside, 0.4 m within 1.2 s.
fn left_hand(frame: u32) -> [f64; 3] {
    let out = covered((f64::from(frame) - 100.0) / 100.0);
    let back = covered((f64::from(frame) - 320.0) / 120.0);
    let aside = 40.0 * 16.0 * back * back * (1.0 - back) * (1.0 - back);
    [-250.0 - aside, 100.0 + 240.0 * out - 400.0 * back, 50.0 + 180.0 * out]
}

/// A folder with one handover of somebody who turned by 90 degrees to the left.
fn handover(lost: Option<u32>, keyframes: &str) -> TempDir {
    let bodies = ["left_hand", "right_hand", "left_shoulder", "right_shoulder", "hip"];
    let columns = bodies.map(|body| format!("{body}.x_mm,{body}.y_mm,{body}.z_mm"));
    let mut text = format!("t_s,{}", columns.join(","));
    for frame in 0..500 {
        write!(text, "\n{:.2}", 0.01 * f64::from(frame)).unwrap();
        let right_hand = [250.0, 0.0, 0.0];
        for (body, place) in
            [left_hand(frame), right_hand, [-180.0, 0.0, 500.0], [180.0, 0.0, 500.0], [0.0; 3]]
                .iter()
                .enumerate()
        {
            match lost {
                Some(lost) if lost == frame && body == 0 => text += ",,,",
                _ => write!(text, ",{:.2},{:.2},{:.2}", 1000.0 - place[1], place[0], place[2]).unwrap(),
            }
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("HumanRobotHandover");
    std::fs::create_dir(&own).unwrap();
    std::fs::write(own.join("0.csv"), text).unwrap();
    std::fs::write(own.join("0.json"), keyframes).unwrap();
    folder
}

const KEYFRAMES: &str = r#"{"keyframes": [200, 310], "object_holding_hand": "left"}"#;

/// The handover, and a carry, for there must be one of each kind: a stack of which only the first hand moves.
fn extracted(folder: &TempDir) -> Extraction {
    let (given, stack) =
        (folder.path().join("HumanRobotHandover"), folder.path().join("CollaborativeStacking"));
    std::fs::create_dir(&stack).unwrap();
    let text =
        std::fs::read_to_string(handover(None, KEYFRAMES).path().join("HumanRobotHandover/0.csv")).unwrap();
    std::fs::write(stack.join("1.csv"), text).unwrap();
    let keyframes = r#"{"keyframes": [80, 250, 300, 310, 315], "first_placing_hand": "left"}"#;
    std::fs::write(stack.join("1.json"), keyframes).unwrap();
    assert!(given.is_dir());
    extract(folder.path()).unwrap()
}

#[test]
fn movements_are_found_with_their_distance_time_and_course() {
    let extraction = extracted(&handover(None, KEYFRAMES));
    assert_eq!((extraction.recordings, extraction.left_out.len()), (2, 0), "{extraction:?}");
    let kinds: Vec<WayKind> = extraction.ways.iter().map(|way| way.kind).collect();
    assert_eq!(kinds, [WayKind::Carry, WayKind::Give, WayKind::Withdraw, WayKind::Withdraw]);
    let give = &extraction.ways[1];
    assert_eq!((give.recording.as_str(), give.hand), ("HumanRobotHandover/0", ArmSide::Left));
    assert!((give.distance - 0.3).abs() < 0.01 && (0.8..1.05).contains(&give.duration), "{give:?}");
    assert!(give.points.iter().all(|[_, aside, up]| aside.abs() < 0.01 && up.abs() < 0.01), "{give:?}");
    assert!((give.points[16][0] - 0.5).abs() < 0.03, "{:?}", give.points[16]);
    let back = &extraction.ways[2];
    assert!((back.distance - 0.4).abs() < 0.01, "{back:?}");
    // Going back, the hand swings out to its own side: for a right hand, to the left of who looks along the way.
    assert!((back.points[16][1] + 0.1).abs() < 0.01, "{:?}", back.points[16]);
}

#[test]
fn the_file_of_the_ways_holds_them_to_the_last_digit() {
    let extraction = extracted(&handover(None, KEYFRAMES));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("carries.csv");
    std::fs::write(&path, ways_text(&extraction.ways)).unwrap();
    assert_eq!(read_ways(&path).unwrap(), extraction.ways);
}

#[test]
fn a_movement_with_a_lost_frame_is_left_out() {
    let extraction = extracted(&handover(Some(380), KEYFRAMES));
    let lost = extraction.left_out.iter().filter(|reason| **reason == LeftOut::Lost).count();
    assert!(lost >= 1, "{extraction:?}");
    let withdrawn = extraction.ways.iter().filter(|way| way.recording == "HumanRobotHandover/0");
    assert_eq!(withdrawn.map(|way| way.kind).collect::<Vec<_>>(), [WayKind::Give]);
}

#[test]
fn recordings_that_cannot_be_used_are_refused_with_the_file() {
    let refused = |keyframes: &str| extract(handover(None, keyframes).path()).unwrap_err().to_string();
    let few = refused(r#"{"keyframes": [200], "object_holding_hand": "left"}"#);
    assert!(few.contains("0.json: keyframes: expected 2 frames, found 1"), "{few}");
    let backwards = refused(r#"{"keyframes": [310, 200], "object_holding_hand": "left"}"#);
    assert!(backwards.contains("0.json: keyframes: expected ascending frames"), "{backwards}");
    assert!(refused(r#"{"keyframes": [200, 310]}"#).contains("0.json: expected first_placing_hand"));
    assert!(refused("{").contains("0.json: "));
    let nobody_carries = extract(handover(None, KEYFRAMES).path()).unwrap_err();
    assert!(matches!(nobody_carries, ExtractionError::Nothing { kind: "carries", .. }), "{nobody_carries}");
}

/// The recordings themselves are not shipped.
#[test]
fn shipped_ways_are_those_of_the_recordings() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let recordings = root.join("../shared/data/motion-capture");
    if !recordings.is_dir() {
        eprintln!("skipped: {} is not there", recordings.display());
        return;
    }
    let text = ways_text(&extract(&recordings).unwrap().ways);
    assert!(text == std::fs::read_to_string(root.join("data/carries/carries.csv")).unwrap(), "coact carries");
}
