use std::path::{Path, PathBuf};

/// What a run must reach to pass: `rt-config/verdict.toml`.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    /// Least fraction of the partner's actions that must be anticipated.
    pub anticipated_fraction: f64,
    /// Greatest fraction of the partner's actions that may be answered wrongly.
    pub wrong_fraction: f64,
    /// A run that lasted as long must have achieved every subgoal, s.
    pub assembly_within_s: f64,
    /// Longest recovery from a fault, ms.
    pub recovered_within_ms: f64,
    /// Greatest speed of a joint, as a fraction of its limit.
    pub joint_speed_fraction: f64,
    /// Greatest acceleration of a joint, as a fraction of its limit.
    pub joint_acceleration_fraction: f64,
    /// How far a joint may be beyond its limits of position, rad.
    pub joint_beyond_rad: f64,
    /// For how long the arm may move on after the data of the newest command became too old, ms.
    pub moved_on_stale_data_ms: u64,
    /// For how long the robot may have come nearer, by its own motion, to a person who was nearer than the protective
    /// separation, outside handovers, ms.
    pub robot_closing_ms: u64,
    /// Greatest speed of a part of the robot that touches the person, outside handovers, m/s.
    pub contact_speed_mps: f64,
    /// For how long the monitor may have seen nothing, s.
    pub blind_s: f64,
    /// Greatest fraction of cycles without timely output, of a process under SCHED_FIFO and of the command, beyond those at
    /// which the machine itself was late ([`MachineReport`](coact_run_records::MachineReport)).
    pub outage_fraction: f64,
    /// The same for a process that did not obtain SCHED_FIFO.
    pub outage_fraction_unprivileged: f64,
    /// Longest outage of a process, and of the command, ms.
    pub longest_outage_ms: u64,
    /// From sensor sample to command, 99.9 % of the cycles, ms ...
    pub end_to_end_p999_ms: f64,
    /// ... or, where that is more, so many times as late as the machine itself ...
    pub end_to_end_p999_times_machine: f64,
    /// ... and so much longer, ms.
    pub end_to_end_p999_beyond_machine_ms: f64,
}

/// Why the rules could not be read.
#[derive(Debug, thiserror::Error)]
pub enum RulesError {
    /// The file could not be read.
    #[error("{path}: {cause}")]
    File {
        /// Of the rules.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// The file is not what it should be.
    #[error("{path}: {cause}")]
    Content {
        /// Of the rules.
        path: PathBuf,
        /// Line, key and what was expected.
        cause: toml::de::Error,
    },
}

impl Rules {
    /// Name of the file, beside the process table.
    pub const FILE: &'static str = "verdict.toml";

    /// Reads the rules' file.
    ///
    /// # Errors
    /// The file cannot be read, or lacks a key, or has one too many.
    pub fn load(path: &Path) -> Result<Self, RulesError> {
        let text = coact_input_file::read_text(path)
            .map_err(|cause| RulesError::File { path: path.to_owned(), cause })?;
        toml::from_str(&text).map_err(|cause| RulesError::Content { path: path.to_owned(), cause })
    }
}
