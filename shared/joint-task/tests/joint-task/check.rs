//! Each kind of thing that can be wrong with a task is found, with its place; nothing else is.
#![allow(clippy::unwrap_used)]

use coact_joint_task::{Finding, FindingKind, check};
use std::path::Path;

fn shipped(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file);
    std::fs::read_to_string(path).unwrap()
}

const BASE: &str = "tasks/template.toml";

/// Findings of the template after the changes.
fn findings(changes: &[(&str, &str)]) -> Vec<Finding> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("tasks")).unwrap();
    std::fs::write(folder.path().join("joint-action.toml"), shipped("joint-action.toml")).unwrap();
    let mut text = shipped(BASE);
    for (from, to) in changes {
        assert!(text.contains(from), "{from:?} does not stand in {BASE}");
        text = text.replacen(from, to, 1);
    }
    let path = folder.path().join(BASE);
    std::fs::write(&path, text).unwrap();
    check(&path).unwrap()
}

fn kinds(findings: &[Finding]) -> Vec<FindingKind> {
    findings.iter().map(|finding| finding.kind).collect()
}

/// Line, counted from 1, on which `text` first stands in the template.
fn line_of(text: &str) -> usize {
    shipped(BASE).lines().position(|line| line.contains(text)).unwrap() + 1
}

#[test]
fn template_is_sound() {
    assert_eq!(findings(&[]), []);
}

#[test]
fn missing_part_is_found_at_the_subgoal_that_goes_without() {
    let found = findings(&[("[[part]]\nkind = \"block\"\nworkspace = \"person\"\nat = [-0.96, 0.06]\n", "")]);
    assert!(kinds(&found).contains(&FindingKind::MissingParts), "{found:?}");
    let part = &found[0];
    assert!(part.what.contains("2 subgoals need a \"block\", and 1 lie"), "{part:?}");
    // The part's five lines are gone from the file.
    let line = line_of("name = \"block on the robot's side\"") - 4;
    assert!(part.place.ends_with(&format!("template.toml:{line}")), "{part:?}");
}

#[test]
fn subgoal_that_nobody_can_bring_about_is_found() {
    let found = findings(&[("type = \"give\"", "type = \"point\"")]);
    assert_eq!(kinds(&found)[0], FindingKind::UnreachableSubgoal);
    assert!(
        found[0].what.contains("\"peg on the person's block\": the robot has no [[action]]"),
        "{found:?}"
    );
    let line = line_of("name = \"peg on the person's block\"");
    assert!(found[0].place.ends_with(&format!(":{line}")), "{found:?}");
    let found = findings(&[("answer = \"receive\"\n", "")]);
    assert_eq!(kinds(&found)[0], FindingKind::UnreachableSubgoal);
    assert!(found[0].what.contains("\"block on the robot's side\""), "{found:?}");
}

#[test]
fn one_grip_for_two_meanings_is_found() {
    let found = findings(&[("grip = \"side\"", "grip = \"top\"")]);
    let ambiguous = found.iter().find(|finding| finding.kind == FindingKind::AmbiguousChain).unwrap();
    assert!(
        ambiguous.what.contains("\"top grip: block\" shows both \"insert: block\" and \"hand over: block\"")
    );
    assert!(ambiguous.place.ends_with(&format!(":{}", line_of("name = \"hand over\""))), "{ambiguous:?}");
    assert!(kinds(&found).contains(&FindingKind::SmallMargin), "the fields find it too: {found:?}");
}

#[test]
fn one_grip_for_two_meanings_at_different_times_is_none() {
    let after = "socket = { at = [-0.55, 0.30, 0.89] }\nafter = [\"block on the person's side\"]";
    let found =
        findings(&[("grip = \"side\"", "grip = \"top\""), ("socket = { at = [-0.55, 0.30, 0.89] }", after)]);
    assert!(!kinds(&found).contains(&FindingKind::AmbiguousChain), "{found:?}");
}

#[test]
fn one_phrase_for_two_meanings_is_found() {
    let found = findings(&[
        ("answer = \"receive\"", "answer = \"receive\"\nsays = [\"the {kind}\"]"),
        ("answer = \"give\"", "answer = \"give\"\nsays = [\"The {kind}\"]"),
    ]);
    let phrase = found.iter().find(|finding| finding.kind == FindingKind::AmbiguousPhrase).unwrap();
    assert!(phrase.what.contains("\"the block\" stands for both"), "{phrase:?}");
}

#[test]
fn two_steps_of_the_robot_s_own_at_once_are_no_clean_decision() {
    let found = findings(&[(
        "after = [\"peg on the person's block\"]",
        "after = [\"block on the robot's side\"]\n\n[[subgoal]]\nname = \"second peg\"\nkind = \"peg\"\nside = \"robot\"\n\
         socket = { at = [-0.55, 0.36, 0.89] }\nafter = [\"block on the robot's side\"]",
    )]);
    let close = |finding: &&Finding| {
        finding.kind == FindingKind::SmallMargin
            && finding.what.contains("second peg")
            && finding.what.contains("AEL")
    };
    let margin = found.iter().find(close).unwrap_or_else(|| panic!("{found:?}"));
    assert!(margin.what.contains("100 % of the input"), "{margin:?}");
}

#[test]
fn shipped_tasks_have_no_fault_but_close_choices() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        for finding in check(&path).unwrap() {
            assert_eq!(finding.kind, FindingKind::SmallMargin, "{}: {finding:?}", path.display());
        }
    }
}
