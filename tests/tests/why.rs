//! The robot of a running set says why it does what it does.
#![allow(clippy::unwrap_used)]

use coact_tests::{Launched, wait_for};
use std::process::Command;

/// What `coact why --json` tells of what is decided.
fn decided(run: &str) -> Vec<serde_json::Value> {
    let mut command = Command::new(coact_tests::coact());
    let output = command.args(["why", "--json", "--run", run]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    told["populations"].as_array().unwrap().clone()
}

#[test]
fn what_is_decided_is_explained_by_synapses_that_add_up_to_it() {
    let mut launched = Launched::start(&["--duration", "30", "--world", "kinematic"]);
    let run = launched.when_started();
    let action = wait_for("a decision", || decided(run.id()).into_iter().next());
    let amounts = action["shares"].as_array().unwrap().iter().map(|share| share["amount"].as_f64().unwrap());
    let (sum, input) = (amounts.sum::<f64>(), action["input"].as_f64().unwrap());
    assert!((sum - input).abs() < 1e-9 && input > 0.0, "{action}");
    let why = action["shares"][0]["why"].as_str().unwrap();
    assert!(action["name"].as_str().unwrap().starts_with("AEL ") && !why.is_empty(), "{action}");
    launched.signal(rustix::process::Signal::INT);
    launched.finish();
}
