//! `coact faults` breaks real sets, and says what became of them.
#![allow(clippy::unwrap_used)]

use coact_tests::{checkout, coact};
use serde_json::Value;
use std::process::{Command, Output};

fn faults(arguments: &[&str]) -> Output {
    let program = coact().with_file_name("coact-studies");
    assert!(program.is_file(), "{} is missing: cargo build --workspace --bins", program.display());
    Command::new(program).arg("faults").args(arguments).current_dir(checkout()).output().unwrap()
}

fn is_green_alone(cell: &Value) -> bool {
    let part = |key: &str| cell[key].as_str().unwrap();
    let cell = format!("{}:{}@{}", part("target"), part("fault"), part("moment"));
    faults(&["--only", &cell]).status.success()
}

#[test]
fn the_quick_part_is_safe_and_nothing_is_left_of_what_broke() {
    let out = tempfile::tempdir().unwrap();
    let output = faults(&["--quick", "--json", "--out", out.path().to_str().unwrap()]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{said}"));
    let cells = report["cells"].as_array().unwrap();
    // A slow machine recovers late, and has no time for all of them; what is done is safe, and the work goes on.
    let are = |outcome: &str| cells.iter().filter(|cell| cell["outcome"] == outcome).count();
    let not_done = cells.iter().filter(|cell| cell["reasons"] == "there was no time left").count();
    let red: Vec<&Value> = cells.iter().filter(|cell| cell["outcome"] == "red").collect();
    let (green, late) = (are("green"), are("late"));
    assert_eq!(green + late + not_done + red.len(), cells.len(), "{said}");
    // A machine that others share stands still at times for longer than a stage may, which is then replaced; not at the same cell twice.
    assert!(red.len() <= 2 && red.iter().all(|cell| is_green_alone(cell)), "{red:?}\n{said}");
    assert!(green > 20, "{green} of {}\n{said}", cells.len());
    let all_done = not_done == 0 && red.is_empty();
    assert_eq!(output.status.code(), Some(i32::from(!all_done)), "{said}");
    let page = std::fs::read_to_string(out.path().join("faults.html")).unwrap();
    assert_eq!(page.matches("<td class=\"green\">").count(), green, "{page}");
    let written = std::fs::read_to_string(out.path().join("faults.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), report);
}

#[test]
fn a_selection_without_cells_is_refused_with_what_is_expected() {
    let output = faults(&["--only", "fields:melt"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("fields:melt") && said.contains("TARGET:FAULT@MOMENT"), "{said}");
}
