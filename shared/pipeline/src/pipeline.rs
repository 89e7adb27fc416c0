use crate::{PipelineError, ProcessEntry, RestartPolicy};
use std::path::Path;
use std::time::Duration;

/// The process table: what runs, in which order, with which real-time properties, and what happens after a crash.
#[derive(Debug, Clone, PartialEq)]
pub struct Pipeline {
    /// What happens when a process dies.
    pub restart: RestartPolicy,
    /// For how long the processes live on when the supervisor has died, so that a successor can adopt them. Zero: they end with
    /// it.
    pub adoptable_for: Duration,
    /// Every process, sorted by [`ProcessEntry::order`].
    pub processes: Vec<ProcessEntry>,
}

impl Pipeline {
    /// Reads a process table.
    ///
    /// # Errors
    /// [`PipelineError`] names file, line and key, and what was expected there.
    pub fn load(path: &Path) -> Result<Self, PipelineError> {
        let text = coact_input_file::read_text(path)
            .map_err(|cause| PipelineError::Unreadable { file: path.to_owned(), cause })?;
        Self::parse(&text, path)
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
