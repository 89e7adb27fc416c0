//! The chapter's figures: all are written, none is empty, and they show what the chapter tells.
#![allow(clippy::unwrap_used)]

use coact_drawing::{Lettering, Mark};
use coact_figures::{Figure, FigureError, Gallery, Index, RunTrace, Scenario};
use std::path::{Path, PathBuf};

fn configuration() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config")
}

fn draw(numbers: &[u32], out: &Path) -> Result<Index, FigureError> {
    let figures = Figure::select(numbers).unwrap();
    Gallery { configuration: &configuration(), out, figures, seed: 1 }.draw(&mut |_| ())
}

/// What the robot decided in each interval of a figure's last run.
fn decisions(index: &Index, number: u32) -> Vec<(String, Vec<String>)> {
    let entry = index.figures.iter().find(|entry| entry.figure == number).unwrap();
    let intervals = &entry.runs.last().unwrap().intervals;
    intervals.iter().map(|interval| (interval.name.clone(), interval.decisions.clone())).collect()
}

#[test]
fn every_figure_is_written_twice_and_listed() {
    let out = tempfile::tempdir().unwrap();
    let index = draw(&[], out.path()).unwrap();
    let numbers: Vec<u32> = index.figures.iter().map(|entry| entry.figure).collect();
    assert_eq!(numbers, [3, 4, 6, 7, 8, 9, 11, 12, 13, 15, 16]);
    for entry in &index.figures {
        let [svg, png] = entry.files.clone().map(|file| std::fs::read(out.path().join(file)).unwrap());
        assert!(svg.starts_with(b"<svg") && png.starts_with(b"\x89PNG"), "figure {}", entry.figure);
        for run in &entry.runs {
            assert!(!run.peaks.is_empty(), "figure {} shows no peak", entry.figure);
        }
    }
    let listed: serde_json::Value =
        serde_json::from_slice(&std::fs::read(out.path().join("figures.json")).unwrap()).unwrap();
    assert_eq!(listed["figures"][4]["runs"][0]["intervals"][0]["name"], "T1");
}

#[test]
fn decisions_are_those_of_the_chapter() {
    let out = tempfile::tempdir().unwrap();
    let index = draw(&[8, 13, 16], out.path()).unwrap();
    let expect = |number, expected: &[(&str, &[&str])]| {
        for ((name, found), (expected_name, expected)) in decisions(&index, number).iter().zip(expected) {
            assert_eq!(name, expected_name, "figure {number}");
            for decision in *expected {
                assert!(found.iter().any(|one| one == decision), "figure {number}, {name}: {found:?}");
            }
        }
        assert_eq!(decisions(&index, number).len(), expected.len(), "figure {number}");
    };
    let request = "request: wheel on the robot's side";
    expect(
        8,
        &[
            ("T1", &[request]),
            ("T2", &["steady the base: wheel on the person's side"]),
            ("T3", &[request]),
            ("T4", &["receive: wheel on the robot's side"]),
        ],
    );
    expect(13, &[("T1", &["give: nut on the person's side"])]);
    expect(
        16,
        &[
            ("T7", &["correct: column 4 in its hole"]),
            ("T8", &["receive: column 1 in its hole", "insert: column 1 in its hole"]),
            ("T9", &["correct: column 3 in its hole"]),
            ("T10", &["steady the base: column 4 in its hole"]),
        ],
    );
}

#[test]
fn the_same_seed_makes_the_same_bytes() {
    let [one, other] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    draw(&[4, 12], one.path()).unwrap();
    draw(&[4, 12], other.path()).unwrap();
    for file in ["figure-04.svg", "figure-04.png", "figure-12.svg", "figure-12.png", "figures.json"] {
        let [one, other] = [&one, &other].map(|folder| std::fs::read(folder.path().join(file)).unwrap());
        assert!(one == other, "{file} differs");
    }
}

#[test]
fn a_run_that_no_figure_needs_is_not_made() {
    let out = tempfile::tempdir().unwrap();
    let figures = Figure::select(&[3]).unwrap();
    // Without scenarios to load, no configuration is needed.
    let gallery = Gallery { configuration: Path::new("nowhere"), out: out.path(), figures, seed: 1 };
    assert_eq!(gallery.draw(&mut |_| ()).unwrap().figures.len(), 1);
}

#[test]
fn an_unknown_number_is_refused_with_those_that_there_are() {
    let error = Figure::select(&[7, 5]).unwrap_err().to_string();
    assert_eq!(error, "figure 5 is unknown; expected some of 3, 4, 6, 7, 8, 9, 11, 12, 13, 15, 16");
}

#[test]
fn a_folder_that_cannot_be_made_is_one_clear_error() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let error = draw(&[3], &file.path().join("figures")).unwrap_err().to_string();
    assert!(
        error.contains("figures: ") && error.ends_with("expected a folder that can be written to"),
        "{error}"
    );
}

#[test]
fn no_letters_touch_others_or_leave_the_sheet() {
    let letters = Lettering::new().unwrap();
    let traces = [Scenario::Proactive, Scenario::Occlusion, Scenario::Errors]
        .map(|scenario| RunTrace::of(scenario, &configuration(), 2, &mut |_| ()).unwrap());
    for figure in Figure::ALL {
        let run = |scenario| traces.iter().find(|run| run.scenario == scenario).unwrap();
        let runs: Vec<&RunTrace> = figure.scenarios().iter().map(|&scenario| run(scenario)).collect();
        let sheet = figure.draw(&runs, 2, &letters).unwrap();
        let rooms: Vec<_> = sheet
            .marks
            .iter()
            .filter_map(|mark| match mark {
                Mark::Text(text) => Some((text.room(&letters), &text.text)),
                _ => None,
            })
            .filter(|(_, text)| !text.is_empty())
            .collect();
        for (index, ([from, to], text)) in rooms.iter().enumerate() {
            let inside =
                from[0] >= 0 && from[1] >= 0 && to[0] <= sheet.width as i32 && to[1] <= sheet.height as i32;
            assert!(inside, "figure {}: {text:?} leaves the sheet", figure.number);
            for ([other_from, other_to], other) in &rooms[index + 1..] {
                let touching = (0..2).all(|axis| from[axis] < other_to[axis] && other_from[axis] < to[axis]);
                assert!(!touching, "figure {}: {text:?} touches {other:?}", figure.number);
            }
        }
    }
}
