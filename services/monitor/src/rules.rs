use std::path::{Path, PathBuf};

/// What a run must reach to pass: `rt-config/verdict.toml`.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    /// Least fraction of the partner's actions that must be anticipated.
    pub anticipated_fraction: f64,
    /// Greatest fraction of the partner's actions that may be answered wrongly.
    pub wrong_fraction: f64,
    /// Greatest fraction of cycles that a process under SCHED_FIFO may publish late, beyond what the machine itself was
    /// late by ([`MachineReport`](coact_run_records::MachineReport)).
    pub missed_fraction: f64,
    /// The same for a process that did not obtain SCHED_FIFO.
    pub missed_fraction_unprivileged: f64,
    /// A run that lasted as long must have achieved every subgoal, s.
    pub assembly_within_s: f64,
    /// Longest recovery from a fault, ms.
    pub recovered_within_ms: f64,
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
        let text = std::fs::read_to_string(path)
            .map_err(|cause| RulesError::File { path: path.to_owned(), cause })?;
        toml::from_str(&text).map_err(|cause| RulesError::Content { path: path.to_owned(), cause })
    }
}
