//! The recordings that are shipped serve wherever no folder is named.
#![allow(clippy::unwrap_used)]

use crate::program::coact;

#[test]
fn a_recorded_partner_is_one_of_the_shipped_people() {
    let report = tempfile::tempdir().unwrap();
    let folder = report.path().to_str().unwrap();
    let run = ["launch", "--lockstep", "--world", "kinematic", "--duration", "1", "--report", folder];
    let output = coact(&[&run[..], &["--partner", "recorded"]].concat());
    assert!(report.path().join("summary.json").is_file(), "{}", String::from_utf8_lossy(&output.stderr));
}
