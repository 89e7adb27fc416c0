use crate::{Intentions, PipelineNode, Rules};
use coact_joint_task::Task;
use coact_robot::JointLimits;
use coact_separation::SeparationMeter;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};

/// What a monitor watches.
#[derive(Debug)]
pub struct Watched {
    /// The report directory.
    pub report: PathBuf,
    /// The task.
    pub task: Task,
    /// The goals that its intention layer can infer.
    pub intentions: Intentions,
    /// The processes that send pulses.
    pub nodes: Vec<PipelineNode>,
    /// Limits of the arm's joints.
    pub limits: Vec<JointLimits>,
    /// Measures the distance of robot and person.
    pub separation: SeparationMeter,
    /// What descends from an older sensor sample is not used.
    pub fresh: Duration,
    /// What the run must reach.
    pub rules: Rules,
    /// Start of the run, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
    /// The same instant by the calendar.
    pub started: SystemTime,
}
