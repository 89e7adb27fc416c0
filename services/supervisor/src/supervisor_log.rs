use coact_run_records::{RecordError, RunLog, SupervisorEvent};
use std::path::Path;

/// Writes the supervisor log: one line for each event, on disk as soon as it happened.
#[derive(Debug)]
pub struct SupervisorLog {
    log: RunLog<SupervisorEvent>,
    /// A write failed and was reported; the run goes on.
    failed: bool,
}

impl SupervisorLog {
    /// Creates the file in the report directory.
    ///
    /// # Errors
    /// The file cannot be created.
    pub fn create(report: &Path) -> Result<Self, RecordError> {
        Ok(Self { log: RunLog::create(report)?, failed: false })
    }

    /// Goes on with the log of a supervisor that was killed.
    ///
    /// # Errors
    /// The file cannot be read or written.
    pub fn open(report: &Path) -> Result<Self, RecordError> {
        Ok(Self { log: RunLog::open(report)?, failed: false })
    }

    /// Writes one event. A full disk must not stop the supervision: the first failure is warned of, once.
    pub fn write(&mut self, event: SupervisorEvent) {
        if let (Err(error), false) = (self.log.append(vec![event]), self.failed) {
            self.failed = true;
            tracing::warn!("{error}; events are missing from the log");
        }
    }
}
