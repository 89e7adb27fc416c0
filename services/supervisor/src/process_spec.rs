use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

/// How one process of the set is started, and how it is known to be ready and alive.
#[derive(Debug, Clone)]
pub struct ProcessSpec {
    /// Its name in the process table.
    pub name: String,
    /// Started in ascending order, stopped in descending order; equal ones together.
    pub order: u32,
    /// True if the set is given up when it cannot be kept alive.
    pub needed: bool,
    /// Started in the supervisor's scheduling class, before all ordinary load; it changes to its own class when it runs.
    pub realtime: bool,
    /// The core that it is pinned to, if any.
    pub core: Option<usize>,
    /// The next one is started ahead, while this one runs.
    pub spare: bool,
    /// The program to run.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
    /// Where it writes `<name>.<generation>.json` when it is ready.
    pub ready_directory: PathBuf,
    /// How long it may take until then; a replacement ten times as long as the first start, if that is less.
    pub ready_within: Duration,
    /// The file that it touches as a sign of life, if it sends no pulses.
    pub heartbeat_file: PathBuf,
    /// Silence (no pulse) after which the watchdog takes it for hung and kills it; `None` for a process without pulses. One
    /// that is not real time gets half a second at least.
    pub hung_after: Option<Duration>,
    /// How long it may take to end after SIGTERM.
    pub stop_grace: Duration,
}

impl ProcessSpec {
    /// The file that this generation of the process writes when it is ready.
    pub fn ready_file(&self, generation: u32) -> PathBuf {
        self.ready_directory.join(format!("{}.{generation}.json", self.name))
    }
}
