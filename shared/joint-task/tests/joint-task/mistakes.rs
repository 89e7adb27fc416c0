//! A mistake in a task or network file gets one error: file, line, key and what was expected.
#![allow(clippy::unwrap_used)]

use coact_joint_task::NetworkPlan;
use std::path::Path;

fn shipped(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file);
    std::fs::read_to_string(path).unwrap()
}

/// Loads the shipped task with `from` replaced by `to` in `file`; the error with the folder cut off.
fn error_after(file: &str, from: &str, to: &str) -> String {
    let task = if file == NETWORK { TASK } else { file };
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("tasks")).unwrap();
    for name in [task, NETWORK] {
        let mut text = shipped(name);
        if name == file {
            assert!(text.contains(from), "{from:?} does not stand in {name}");
            text = text.replacen(from, to, 1);
        }
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let error = NetworkPlan::load(&folder.path().join(task)).unwrap_err().to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
}

/// Line, counted from 1, on which `text` first stands in the shipped `file` .
fn line_of(file: &str, text: &str) -> usize {
    shipped(file).lines().position(|line| line.contains(text)).unwrap() + 1
}

const TASK: &str = "tasks/toy-vehicle.toml";
/// The one with alternatives.
const TEA: &str = "tasks/tea.toml";
const NETWORK: &str = "joint-action.toml";

#[test]
fn unknown_kind_is_named_with_the_known_ones() {
    let error = error_after(TASK, "[[part]]\nkind = \"wheel\"", "[[part]]\nkind = \"wheal\"");
    let line = line_of(TASK, "[[part]]") + 1;
    assert!(error.starts_with(&format!("{TASK}:{line}: part[0].kind: \"wheal\" is not defined")), "{error}");
    assert!(error.contains("expected one of \"wheel\", \"nut\""), "{error}");
}

#[test]
fn plan_that_runs_in_a_circle_is_refused() {
    let error = error_after(
        TASK,
        "after = [\"wheel on the robot's side\"]",
        "after = [\"top floor on the columns\"]",
    );
    assert!(error.contains("the plan runs in a circle"), "{error}");
}

#[test]
fn choices_that_are_none_are_refused() {
    let two = "count = 2";
    for (from, to, place, expected) in [
        (
            two,
            "count = 3",
            two,
            "choice[1].count: 3 of 3 subgoals; expected 1 or more, and fewer than it offers",
        ),
        (two, "count = 0", two, "choice[1].count: 0 of 3 subgoals"),
        (
            "of = [\"cup on the saucer\", \"glass on the tray\"]",
            "of = [\"cup on the saucer\", \"oat biscuit on the tray\", \"glass on the tray\"]",
            "of = [\"ginger",
            "choice[1].of: \"oat biscuit on the tray\" is offered twice",
        ),
        (
            "after = [\"something to drink from\", \"two biscuits\"]",
            "after = [\"something to drink from\", \"glass on the tray\"]",
            "name = \"tea pot in the middle\"",
            "comes after \"glass on the tray\", which nobody needs once \"something to drink from\" is made",
        ),
        (
            "socket = { at = [-0.70, 0.36, 0.820] }",
            "socket = { at = [-0.70, 0.36, 0.820] }\nafter = [\"something to drink from\"]",
            "name = \"glass on the tray\"",
            "the plan runs in a circle here",
        ),
        (
            "name = \"two biscuits\"",
            "name = \"oat biscuit on the tray\"",
            "name = \"two biscuits\"",
            "stands twice",
        ),
    ] {
        let error = error_after(TEA, from, to);
        let lines = [line_of(TEA, place), line_of(TEA, place) + 1].map(|line| format!("{TEA}:{line}: "));
        assert!(lines.iter().any(|line| error.contains(line)) && error.contains(expected), "{error}");
    }
}

#[test]
fn missing_key_is_named() {
    let error = error_after(TASK, "name = \"toy vehicle\"", "");
    assert!(error.contains(": name: missing field `name`"), "{error}");
}

#[test]
fn misspelt_key_is_named_with_its_line() {
    let error = error_after(TASK, "mass = 0.06", "masse = 0.06");
    let line = line_of(TASK, "mass = 0.06");
    assert!(error.starts_with(&format!("{TASK}:{line}: masse: unknown field `masse`")), "{error}");
}

#[test]
fn number_where_a_name_belongs_is_refused() {
    let error = error_after(TASK, "side = \"person\"", "side = 3");
    let line = line_of(TASK, "side = \"person\"");
    assert!(error.starts_with(&format!("{TASK}:{line}: side:")), "{error}");
}

#[test]
fn negative_width_is_refused() {
    let error = error_after(TASK, "width = 0.075", "width = -0.075");
    assert!(error.ends_with("kind[0].width: -0.075; expected 0.0001 to 1 (m)"), "{error}");
}

#[test]
fn every_number_has_a_range() {
    for (from, to, key) in [
        ("radius = 0.0375", "radius = nan", "kind[0].shape.cylinder.radius"),
        ("height = 0.025", "height = 1e300", "kind[0].shape.cylinder.height"),
        ("height = 0.025", "height = -1e300", "kind[0].shape.cylinder.height"),
        ("height = 0.025", "height = 0xFFFFFFFF", "kind[0].shape.cylinder.height"),
        ("mass = 0.06", "mass = inf", "kind[0].mass"),
    ] {
        let error = error_after(TASK, from, to);
        let line = line_of(TASK, from);
        assert!(error.starts_with(&format!("{TASK}:{line}: {key}: ")), "{to}: {error}");
        assert!(error.contains("; expected 0.000"), "{to}: {error}");
    }
}

#[test]
fn part_outside_its_workspace_is_refused() {
    let error = error_after(TASK, "workspace = \"person\"", "workspace = \"robot\"");
    assert!(error.contains("part[0].at") && error.contains("outside its workspace"), "{error}");
}

#[test]
fn more_sites_than_any_memory_has_are_refused() {
    let error = error_after(NETWORK, "per_population = 10", "per_population = 9223372036854775807");
    assert!(error.contains("populations of 9223372036854775807 sites; expected at least"), "{error}");
}

#[test]
fn missing_network_file_is_named() {
    let error = error_after(TASK, "../joint-action.toml", "../nothing.toml");
    assert!(error.contains(": network: no file") && error.contains("nothing.toml"), "{error}");
}

#[test]
fn unknown_layer_of_a_rule_is_named_with_the_known_ones() {
    let error = error_after(NETWORK, "to = { layer = \"AOL\" }", "to = { layer = \"AOLL\" }");
    assert!(error.contains("synapse[0].to.layer: \"AOLL\" is unknown; expected one of \"AOL\""), "{error}");
}

#[test]
fn time_scale_too_short_for_the_step_is_refused() {
    let error = error_after(NETWORK, "name = \"AOL\"\ntau = 20", "name = \"AOL\"\ntau = 5");
    assert!(error.contains("layer[0].tau (AOL): tau is 5; expected at least 20 ms"), "{error}");
}

#[test]
fn fields_that_cannot_select_are_refused() {
    for (key, wrong, expected) in [
        ("tau = 20", "tau = 5", "destinations.tau: 5 is too little; expected a number of at least 20"),
        (
            "spacing = [0.025, 0.025]",
            "spacing = [0.025, 0.001]",
            "destinations.spacing: 0.001 is too little; expected a number of at least 0.01",
        ),
        ("spacing = [0.025,", "spacing = [nan,", "destinations.spacing: NaN is too little"),
        (
            "spacing = [0.025, 0.025]",
            "spacing = [0.01, 0.01]",
            "destinations.spacing: 0.01 x 0.01 is too fine for a field that reaches ",
        ),
        ("undue = 0.3", "undue = 0", "undue: expected a number above 0, at most 1"),
        ("input_sigma = [0.025,", "input_sigma = [0.001,", "destinations.input_sigma: 0.001 is too little"),
        ("h = -2.0", "h = 1.0", "destinations.h: expected a resting level below 0"),
        ("inhibition = 1.0", "inhibition = -1", "destinations.inhibition: -1 is too little"),
        (
            "sigma = [0.025, 0.025] }",
            "sigma = [0, 0.025] }",
            "destinations.excitation.sigma: 0 is too little",
        ),
        (
            "spacing = [12, 0.012]",
            "spacing = [1, 0.001]",
            "grips.spacing: 1 x 0.001 is too fine for a field that ",
        ),
        ("spacing = [12, 0.012]", "spacing = [0.5, 0.012]", "grips.spacing: 0.5 is too little"),
        ("input_sigma = [12, 0.012]", "input_sigma = [11, 0.012]", "grips.input_sigma: 11 is too little"),
        (
            "sigma = [0.025, 0.025] }",
            "sigma = [1e9, 1e9] }",
            "destinations.excitation.sigma: sigma is 1000000000",
        ),
    ] {
        let error = error_after(NETWORK, key, wrong);
        assert!(error.contains(expected), "{wrong}: {error}");
    }
}

#[test]
fn table_too_large_for_the_network_s_field_names_both_files() {
    let error = error_after(TASK, "min = [-1.17, 0.00]", "min = [-5.0, 0.00]");
    assert!(error.contains("joint-action.toml"), "{error}");
    assert!(error.contains("destinations.spacing: 0.025 x 0.025 is too fine"), "{error}");
    assert!(error.ends_with("(the network of tasks/toy-vehicle.toml)"), "{error}");
}

#[test]
fn missing_file_is_one_clear_error() {
    let error = NetworkPlan::load(Path::new("no/such/task.toml")).unwrap_err().to_string();
    assert!(error.starts_with("no/such/task.toml:0: file: "), "{error}");
}
