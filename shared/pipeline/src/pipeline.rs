use crate::{PipelineError, ProcessEntry, RestartPolicy, pipeline_file};
use std::path::Path;

/// The process table: what runs, in which order, with which real-time properties, and what happens after a crash.
#[derive(Debug, Clone, PartialEq)]
pub struct Pipeline {
    /// Length of one cycle, µs.
    pub period_us: u64,
    /// Offset from a cycle's release after which its output counts as missed, µs.
    pub deadline_us: u64,
    /// What happens when a process dies.
    pub restart: RestartPolicy,
    /// Every process, sorted by [`ProcessEntry::order`].
    pub processes: Vec<ProcessEntry>,
}

impl Pipeline {
    /// Reads a process table.
    ///
    /// # Errors
    /// [`PipelineError`] names file, line and key, and what was expected there.
    pub fn load(path: &Path) -> Result<Self, PipelineError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| PipelineError::Unreadable { file: path.to_owned(), source })?;
        Self::parse(&text, path)
    }

    /// Reads a process table from `text`; `file` is only named in errors.
    ///
    /// # Errors
    /// As [`Pipeline::load`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, PipelineError> {
        pipeline_file::parse(text, file)
    }

    /// Length of one cycle, ns.
    pub fn period_ns(&self) -> u64 {
        self.period_us * 1000
    }

    /// The entry of the process called `name`.
    ///
    /// # Errors
    /// [`PipelineError::UnknownProcess`], with the names that do exist.
    pub fn process(&self, name: &str) -> Result<&ProcessEntry, PipelineError> {
        self.processes.iter().find(|entry| entry.name == name).ok_or_else(|| PipelineError::UnknownProcess {
            name: name.to_owned(),
            known: self.processes.iter().map(|entry| entry.name.clone()).collect(),
        })
    }
}
