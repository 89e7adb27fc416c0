//! Process tables: what is read, what is refused and in which words, and what the reference table shows.
#![allow(clippy::unwrap_used)]

use coact_pipeline::{Pipeline, Trigger};
use std::time::Duration;

const GOOD: &str = r#"# A table.
[restart]
intensity = 3
window_s = 10
[[process]]
name = "fields"
program = "coact-fields"
order = 3
realtime = true
priority = 81
trigger = "coact/percept"
latest_start_us = 600
[[process]]
name = "world"
program = "coact-world"
order = 1
trigger = "timer"
"#;

fn refused(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "the test replaces nothing");
    Pipeline::parse(&GOOD.replacen(from, to, 1), "p.toml".as_ref()).unwrap_err().to_string()
}

#[test]
fn processes_are_sorted_by_order_and_defaults_apply() {
    let pipeline = Pipeline::parse(GOOD, "p.toml".as_ref()).unwrap();
    let names: Vec<_> = pipeline.processes.iter().map(|entry| entry.name.as_str()).collect();
    assert_eq!(names, ["world", "fields"]);
    assert_eq!((pipeline.restart.intensity, pipeline.restart.window), (3, Duration::from_secs(10)));
    let fields = pipeline.process("fields").unwrap();
    assert_eq!(fields.trigger, Trigger::Topic("coact/percept".to_owned()));
    assert_eq!(fields.latest_start, Duration::from_micros(600));
    assert_eq!((fields.ready_within, fields.stop_grace), (Duration::from_secs(10), Duration::from_secs(1)));
}

#[test]
fn every_mistake_names_file_line_key_and_what_was_expected() {
    let cases = [
        ("priority = 81", "priority = 100", "p.toml:10: priority: is 100; expected 1 to 99"),
        (
            "latest_start_us = 600",
            "latest_start_us = 1000",
            "p.toml:12: latest_start_us: is 1000; expected less than 1000, the period",
        ),
        (
            "name = \"world\"",
            "name = \"fields\"",
            "p.toml:14: name: is fields; expected a name that no process",
        ),
        ("name = \"world\"", "name = \"My World\"", "p.toml:14: name: is My World; expected 1 to 32 of"),
        ("window_s = 10", "window_s = 0", "p.toml:4: window_s: is 0; expected seconds"),
        ("intensity = 3", "hung_after_ms = 4", "p.toml:3: hung_after_ms: is 4; expected at least 5"),
        ("order = 3", "order = \"x\"", "p.toml:8: order: invalid type: string \"x\"; expected u32"),
        (
            "realtime = true",
            "real_time = true",
            "p.toml:9: real_time: unknown field `real_time`; expected one of",
        ),
        ("priority = 81\n", "", "p.toml:6: name: is fields; expected a key \"priority\""),
        ("latest_start_us = 600\n", "", "p.toml:6: name: is fields; expected a key \"latest_start_us\""),
        ("[restart]", "[restart", "p.toml:2: "),
        (
            "[restart]",
            "[supervision]\nadoptable_for_s = -1\n[restart]",
            "p.toml:3: adoptable_for_s: is -1; expected 0 to 3600, seconds",
        ),
        (
            "[restart]",
            "[supervision]\nadoptable_for_s = nan\n[restart]",
            "p.toml:3: adoptable_for_s: is NaN; expected 0 to 3600",
        ),
    ];
    for (from, to, message) in cases {
        let found = refused(from, to);
        assert!(found.starts_with(message), "{from} -> {to}:\n{found}\nshould start with\n{message}");
    }
}

#[test]
fn the_period_and_the_deadline_are_no_settings() {
    for (key, reason) in
        [("period_us", "the period is 1 ms, a constant"), ("deadline_us", "one period after the release")]
    {
        for value in [1000, 500] {
            let found = refused("# A table.", &format!("{key} = {value}"));
            assert!(found.starts_with(&format!("p.toml:1: {key}: is not a setting: ")), "{found}");
            assert!(found.contains(reason) && found.ends_with("remove it"), "{found}");
        }
    }
}

#[test]
fn a_file_that_cannot_be_read_says_why_once() {
    let error = Pipeline::load("/no/such/pipeline.toml".as_ref()).unwrap_err();
    let shown = format!("{:#}", anyhow::Error::from(error));
    assert_eq!(shown.matches("No such file").count(), 1, "{shown}");
    assert!(
        shown.starts_with("/no/such/pipeline.toml: ") && shown.contains("rt-config/pipeline.toml"),
        "{shown}"
    );
}

#[test]
fn missing_key_names_the_entry_that_lacks_it() {
    let found = refused("program = \"coact-world\"\n", "");
    assert!(found.contains("p.toml:13: ") && found.contains("missing field `program`"), "{found}");
}

#[test]
fn unknown_process_is_told_the_known_ones() {
    let pipeline = Pipeline::parse(GOOD, "p.toml".as_ref()).unwrap();
    let found = pipeline.process("field").unwrap_err().to_string();
    assert_eq!(found, "no process is called \"field\"; expected one of: world, fields");
}

const REFERENCE: &str = include_str!("../../../../rt-config/pipeline.toml");

#[test]
fn reference_table_is_read_and_shows_the_defaults_of_the_restart_policy() {
    let pipeline = Pipeline::parse(REFERENCE, "pipeline.toml".as_ref()).unwrap();
    let started_by_the_timer = pipeline.processes.iter().filter(|entry| entry.trigger == Trigger::Timer);
    assert_eq!(started_by_the_timer.count(), 1);
    let defaults = Pipeline::parse("process = []", "defaults".as_ref()).unwrap();
    assert_eq!(pipeline.restart, defaults.restart);
    assert_eq!(pipeline.adoptable_for, defaults.adoptable_for);
}

#[test]
fn reference_table_explains_every_key() {
    let process = "[[process]]\nunknown = 1";
    let tables = ["[restart]", "[supervision]"].map(|table| format!("process = []\n{table}\nunknown = 1"));
    for text in ["unknown = 1\nprocess = []", process].into_iter().chain(tables.iter().map(String::as_str)) {
        let refusal = Pipeline::parse(text, "p.toml".as_ref()).unwrap_err().to_string();
        // Of two keys the parser says "expected `a` or `b`", of more "expected one of `a`, `b`, `c`".
        let (_, keys) = refusal.split_once("expected ").unwrap();
        for key in keys.split('`').skip(1).step_by(2) {
            let explained = |line: &str| {
                let in_comment =
                    line.strip_prefix("# ").is_some_and(|text| text.starts_with(&format!("{key} ")));
                in_comment || (line.starts_with(&format!("{key} = ")) && line.contains(" # "))
            };
            let is_table = REFERENCE.contains(&format!("[{key}]"));
            assert!(is_table || REFERENCE.lines().any(explained), "{key} is not explained");
        }
    }
}

#[test]
fn a_standby_is_a_process_of_its_own_that_the_task_can_do_without() {
    let with = GOOD.replacen("priority = 81\n", "priority = 81\nstandby = true\n", 1);
    let pipeline = Pipeline::parse(&with, "p.toml".as_ref()).unwrap();
    let (stage, standby) = (pipeline.process("fields").unwrap(), pipeline.process("fields-standby").unwrap());
    assert_eq!((stage.standby_of.as_deref(), standby.standby_of.as_deref()), (None, Some("fields")));
    assert_eq!((standby.priority, standby.needed, &standby.trigger), (82, false, &stage.trigger));
    let taken = with.replacen("name = \"world\"", "name = \"fields-standby\"", 1);
    let refused = Pipeline::parse(&taken, "p.toml".as_ref()).unwrap_err().to_string();
    assert!(refused.contains("a name that no process above has"), "{refused}");
}

#[test]
fn a_set_ends_with_its_supervisor_unless_the_table_says_for_how_long_it_can_be_adopted() {
    assert_eq!(Pipeline::parse(GOOD, "p.toml".as_ref()).unwrap().adoptable_for, Duration::ZERO);
    let table = GOOD.replacen("[restart]", "[supervision]\nadoptable_for_s = 2.5\n[restart]", 1);
    let adoptable = Pipeline::parse(&table, "p.toml".as_ref()).unwrap();
    assert_eq!(adoptable.adoptable_for, Duration::from_millis(2500));
}

#[test]
fn what_has_a_trigger_may_have_a_spare_and_nothing_else() {
    let with = GOOD.replacen("priority = 81\n", "priority = 81\nspare = true\nstandby = true\n", 1);
    let pipeline = Pipeline::parse(&with, "p.toml".as_ref()).unwrap();
    assert!(pipeline.process("fields").unwrap().spare && !pipeline.process("world").unwrap().spare);
    assert!(!pipeline.process("fields-standby").unwrap().spare, "it is no standby's");
    let without =
        format!("{GOOD}\n[[process]]\nname = \"viewer\"\nprogram = \"view\"\norder = 2\nspare = true\n");
    let error = Pipeline::parse(&without, "p.toml".as_ref()).unwrap_err().to_string();
    assert!(error.contains("spare: is true") && error.contains("without a trigger"), "{error}");
}

#[test]
fn what_starts_on_request_is_in_the_table_of_a_run_that_asks_for_it_and_in_no_other() {
    let pipeline = Pipeline::parse(REFERENCE, "pipeline.toml".as_ref()).unwrap();
    let names = |requested: &[&str]| -> Result<Vec<String>, String> {
        let requested: Vec<_> = requested.iter().map(|name| (*name).to_owned()).collect();
        let table = pipeline.clone().with_requested(&requested).map_err(|error| error.to_string())?;
        Ok(table.processes.into_iter().map(|entry| entry.name).collect())
    };
    let has_recorder = |names: Vec<String>| names.iter().any(|name| name == "recorder");
    assert!(!has_recorder(names(&[]).unwrap()));
    assert!(has_recorder(names(&["recorder"]).unwrap()));
    assert_eq!(names(&["voice"]).unwrap(), names(&[]).unwrap(), "it is there anyway");
    let refused = names(&["camera"]).unwrap_err();
    assert!(refused.starts_with("no process is called \"camera\"; expected one of: "), "{refused}");
}
