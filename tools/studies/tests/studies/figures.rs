//! `coact figures`: what it prints and how it refuses.
#![allow(clippy::unwrap_used)]

use crate::program::coact;
use std::process::Output;

fn figures(arguments: &[&str]) -> Output {
    coact(&[&["figures"], arguments].concat())
}

#[test]
fn a_figure_is_written_and_named() {
    let out = tempfile::tempdir().unwrap();
    let output = figures(&["--only", "3", "--out", out.path().to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("figure-03.svg and .png: "));
    for file in ["figure-03.svg", "figure-03.png", "figures.json"] {
        assert!(out.path().join(file).is_file(), "{file}");
    }
}

#[test]
fn an_unknown_number_is_refused_with_those_that_there_are() {
    let out = tempfile::tempdir().unwrap();
    let output = figures(&["--only", "7,5", "--out", out.path().to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("figure 5 is unknown; expected some of 3, 4, 6, 7"), "{said}");
    assert_eq!(out.path().read_dir().unwrap().count(), 0, "nothing is written");
}

#[test]
fn a_folder_that_cannot_be_written_to_is_one_error() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let output = figures(&["--only", "3", "--out", file.path().join("figures").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.lines().count() == 1 && said.contains("expected a folder that can be written to"), "{said}");
}
