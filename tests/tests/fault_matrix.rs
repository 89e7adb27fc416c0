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

#[test]
fn every_cell_is_judged_and_nothing_is_left_of_what_broke() {
    let out = tempfile::tempdir().unwrap();
    let only = "supervisor:kill@moving,control:crash-loop@moving,set:planted-run@moving";
    let output = faults(&["--only", only, "--json", "--out", out.path().to_str().unwrap()]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{said}"));
    let cells = report["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 3, "{report}");
    for cell in cells {
        assert_ne!(cell["outcome"], "unknown", "{cell}\n{said}");
        for reason in cell["reasons"].as_array().into_iter().flatten() {
            // On a machine that other tests share the joints' acceleration is not to be judged: coact faults does.
            assert!(reason.as_str().unwrap().contains("acceleration"), "{cell}\n{said}");
        }
    }
    let is_red = |cell: &&Value| cell["outcome"] == "red";
    let red = cells.iter().filter(is_red).count();
    assert_eq!(output.status.code(), Some(i32::from(red > 0)), "{said}");
    let page = std::fs::read_to_string(out.path().join("faults.html")).unwrap();
    assert_eq!(page.matches("<td class=\"red\">").count(), red, "{page}");
    assert_eq!(page.matches("<td class=\"green\">").count(), 3 - red, "{page}");
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
