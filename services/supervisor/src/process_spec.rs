use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

/// How one process of the set is started, and how it is known to be ready and alive.
#[derive(Debug, Clone)]
pub struct ProcessSpec {
    /// Its name in the pipeline.
    pub name: String,
    /// The program to run.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
    /// The file that it writes when it is ready.
    pub ready_file: PathBuf,
    /// How long it may take until then.
    pub ready_within: Duration,
    /// Silence (no pulse) after which it counts as hung and is killed; `None` for a process without pulses.
    pub hung_after: Option<Duration>,
}
