use crate::{PipelineError, ProcessEntry, RestartPolicy, RunSettings};
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

    /// The process table of a run: without the processes that start only on request and that it has not requested.
    ///
    /// # Errors
    /// As [`Pipeline::load`]; [`PipelineError::UnknownProcess`] for a request of a process that the table does not have.
    pub fn of_run(settings: &RunSettings) -> Result<Self, PipelineError> {
        Self::load(&settings.pipeline)?.with_requested(&settings.requested)
    }

    /// The table without the processes that start only on request and are not `requested`.
    ///
    /// # Errors
    /// [`PipelineError::UnknownProcess`].
    pub fn with_requested(mut self, requested: &[String]) -> Result<Self, PipelineError> {
        requested.iter().try_for_each(|name| self.process(name).map(drop))?;
        self.processes.retain(|entry| !entry.on_request || requested.contains(&entry.name));
        Ok(self)
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
