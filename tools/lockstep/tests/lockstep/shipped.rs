//! The stages with what the project ships.
#![allow(dead_code, reason = "each test program uses its part")]

use coact_joint_task::Task;
use coact_lockstep::Lockstep;
use coact_messages::{FieldFrame, NONE};
use coact_pipeline::{RunSettings, WorldMode};
use std::path::{Path, PathBuf};

pub fn configuration() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config")
}

pub fn settings(seed: u64, partner: &str) -> RunSettings {
    RunSettings {
        seed,
        partner: partner.into(),
        world: WorldMode::Kinematic,
        ..RunSettings::shipped(&configuration())
    }
}

/// Name of the robot's decision.
pub fn decision(stages: &Lockstep) -> Option<&str> {
    decision_in(&stages.frame, stages.task())
}

/// Name of the decision in this frame.
pub fn decision_in<'a>(frame: &FieldFrame, task: &'a Task) -> Option<&'a str> {
    match frame.decision.action {
        NONE => None,
        action => Some(&task.actions[action as usize].name),
    }
}
