//! Demonstrations from files, and what is refused.
#![allow(clippy::unwrap_used)]

use coact_learning::{Demonstration, LearnError, Step};

fn read(name: &str, text: &str) -> Result<Vec<Demonstration>, LearnError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    Demonstration::read(&path, &["cup".into(), "spoon".into()])
}

fn refused(name: &str, text: &str) -> String {
    read(name, text).unwrap_err().to_string()
}

const STEPS: [Step; 2] = [Step { at_ms: 1500, subgoal: 1 }, Step { at_ms: 3000, subgoal: 0 }];

#[test]
fn toml_and_csv_say_the_same() {
    let toml =
        "[[achieved]]\nseconds = 3.0\nsubgoal = \"cup\"\n[[achieved]]\nseconds = 1.5\nsubgoal = \"spoon\"\n";
    assert_eq!(read("a.toml", toml).unwrap()[0].steps, STEPS);
    assert_eq!(read("a.csv", "seconds,subgoal\n1.5,spoon\n3,cup\n").unwrap()[0].steps, STEPS);
}

#[test]
fn a_report_holds_one_demonstration_for_each_completed_assembly() {
    // What really happened, in the other order, is not what the robot saw.
    let text = r#"{"event":"decision","at_ms":900,"action":"give: cup"}
{"event":"subgoal","at_ms":1300,"assembly":0,"subgoal":0,"name":"cup"}
{"event":"subgoal","at_ms":1400,"assembly":0,"subgoal":1,"name":"spoon"}
{"event":"perceived","at_ms":1500,"assembly":0,"subgoal":1,"name":"spoon"}
{"event":"assembly","at_ms":1400,"completed":1}
{"event":"perceived","at_ms":3000,"assembly":0,"subgoal":0,"name":"cup"}
{"event":"perceived","at_ms":9000,"assembly":1,"subgoal":0,"name":"cup"}
"#;
    let read = read("events.jsonl", text).unwrap();
    assert_eq!(read.len(), 1, "the second one was broken off");
    assert_eq!(read[0].steps, STEPS);
}

#[test]
fn unknown_subgoal_is_named_with_the_known_ones() {
    let error = refused("a.csv", "seconds,subgoal\n1.5,fork\n3,cup\n");
    assert!(error.contains("a.csv:2: \"fork\" is no subgoal of the task"), "{error}");
    assert!(error.contains("expected one of \"cup\", \"spoon\""), "{error}");
}

#[test]
fn contradictory_or_incomplete_demonstrations_are_refused() {
    let twice = refused("a.csv", "seconds,subgoal\n1.5,cup\n3,cup\n4,spoon\n");
    assert!(twice.contains("a.csv:3: \"cup\" is achieved a second time"), "{twice}");
    let missing = refused("a.csv", "seconds,subgoal\n1.5,cup\n");
    assert!(missing.contains("\"spoon\" is never achieved"), "{missing}");
}

#[test]
fn what_is_no_demonstration_is_refused_with_its_place() {
    assert!(
        refused("a.toml", "[[achieved]]\nseconds = 1\nname = \"cup\"\n").contains("a.toml:3: unknown field")
    );
    assert!(refused("a.csv", "seconds,subgoal\nsoon,cup\n").contains("a.csv:2: "));
    assert!(refused("a.csv", "seconds,subgoal\n-1,cup\n").contains("expected a time from the start"));
    assert!(refused("events.jsonl", "{\"event\":\n").contains("events.jsonl:1: not a line of this log"));
    assert!(refused("a.txt", "").contains("expected a demonstration"));
    assert!(read("empty.jsonl", "").unwrap_err().to_string().contains("no subgoal was perceived"));
}
