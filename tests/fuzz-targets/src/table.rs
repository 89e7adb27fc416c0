use crate::{Input, Target, configuration, messages, records, requests, robots, run_recordings, states};

const fn target(
    name: &'static str,
    input: Input,
    seeds: &'static [&'static str],
    run: fn(&[u8]) -> bool,
) -> Target {
    Target { name, input, seeds, run }
}

/// Every target.
pub const TARGETS: [Target; 50] = [
    target("process-table", Input::Text, &["rt-config/pipeline.toml"], configuration::process_table),
    target("safety-limits", Input::Text, &["rt-config/safety.toml"], configuration::safety_limits),
    target("verdict-rules", Input::Text, &["rt-config/verdict.toml"], configuration::verdict_rules),
    target("recorder-settings", Input::Text, &["rt-config/recorder.toml"], configuration::recorder_settings),
    target("console-settings", Input::Text, &["rt-config/console.toml"], configuration::console_settings),
    target("network-file", Input::Text, &["rt-config/joint-action.toml"], configuration::network_file),
    target("task-file", Input::Text, &["rt-config/tasks/*.toml"], configuration::task_file),
    target("learned-mapping", Input::Text, &["rt-config/learned/*.toml"], configuration::learned_mapping),
    target("scenario", Input::Text, &["rt-config/scenarios/*.toml"], configuration::scenario),
    target("preshape-model", Input::Text, &["rt-config/perception/*.toml"], configuration::preshape_model),
    target(
        "demonstration",
        Input::Text,
        &["rt-config/demonstrations/toy-vehicle/*.toml"],
        configuration::demonstration,
    ),
    target("demonstration-table", Input::Text, &[], configuration::demonstration_table),
    target("robot-file", Input::Text, &["rt-config/robots/*.toml"], robots::robot_file),
    target("urdf", Input::Text, &["rt-config/robots/*.urdf"], robots::urdf),
    target("mesh-stl", Input::Bytes, &[], robots::mesh_stl),
    target("mesh-obj", Input::Text, &[], robots::mesh_obj),
    target("mesh-collada", Input::Text, &[], robots::mesh_collada),
    target("recording", Input::Text, &[], records::recording),
    target("compressed-recording", Input::Bytes, &[], records::compressed_recording),
    target("motion-capture", Input::Text, &[], records::motion_capture),
    target("recorded-ways", Input::Text, &["data/carries/carries.csv"], records::recorded_ways),
    target("run-recording", Input::Patch, &[], run_recordings::run_recording),
    target("event-log", Input::Text, &[], records::event_log),
    target("supervisor-log", Input::Text, &[], records::supervisor_log),
    target("snapshot-log", Input::Text, &[], records::snapshot_log),
    target("summary", Input::Text, &[], records::summary),
    target("interval-log", Input::Text, &[], records::interval_log),
    target("latency-counters", Input::Text, &[], records::latency_counters),
    target("run-description", Input::Text, &[], records::run_description),
    target("run-owner", Input::Text, &[], records::run_owner),
    target("readiness", Input::Text, &[], records::readiness),
    target("start", Input::Text, &[], records::start),
    target("control-request", Input::Text, &[], requests::control_request),
    target("injection", Input::Text, &[], requests::injection),
    target("partner", Input::Text, &[], requests::partner),
    target("hand-line", Input::Text, &[], requests::hand_line),
    target("page-request", Input::Text, &[], requests::page_request),
    target("message-sample", Input::Patch, &[], messages::sample),
    target("message-percept", Input::Patch, &[], messages::percept),
    target("message-frame", Input::Patch, &[], messages::frame),
    target("message-command", Input::Patch, &[], messages::command),
    target("message-truth", Input::Patch, &[], messages::truth),
    target("message-world-state", Input::Patch, &[], messages::world_state),
    target("message-speech", Input::Patch, &[], messages::speech),
    target("message-hand", Input::Patch, &[], messages::hand),
    target("message-pulse", Input::Patch, &[], messages::pulse),
    target("state-perception", Input::Patch, &[], states::perception),
    target("state-fields", Input::Patch, &[], states::fields),
    target("state-control", Input::Patch, &[], states::control),
    target("state-world", Input::Patch, &[], states::world),
];

/// The target of this name.
pub fn find(name: &str) -> Option<&'static Target> {
    static ALL: [Target; TARGETS.len()] = TARGETS;
    ALL.iter().find(|target| target.name == name)
}

/// Gives the target of this name some bytes: for `cargo fuzz`.
///
/// # Panics
/// There is no such target, or it panics.
pub fn run(name: &str, bytes: &[u8]) {
    let target = find(name).unwrap_or_else(|| panic!("no target is called {name}"));
    (target.run)(bytes);
}
