//! The recordings that are shipped serve wherever no folder is named.
#![allow(clippy::unwrap_used)]

use crate::program::coact;

#[test]
fn reaches_are_those_of_the_shipped_people() {
    let output = coact(&["reaches", "--person", "7"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("data/reaches holds no reach of this participant"), "{said}");
}

#[test]
fn motion_capture_that_is_absent_is_one_error_that_says_how_to_name_another_folder() {
    let output = coact(&["carries", "--from", "no/such/folder"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("no/such/folder: no such folder") && said.contains("--from"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}
