use crate::{Ready, RunError, RunSettings, shared_memory};
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};

/// One run of the process set: its directory, its identity, and the names that keep it apart from other runs.
///
/// ```text
/// /dev/shm/coact_<id>/run.json     what the run is made of
///                    /start        clock reading of tick 0, written when all are ready
///                    /config/      iceoryx2.toml: where other iceoryx2 clients find the run's topics
///                    /ready/       <name>.<generation>.json, one for each process start
///                    /iox/         root directory of iceoryx2
/// /dev/shm/coact_<id>_*            the run's shared memory
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    directory: PathBuf,
    description: Description,
}

/// Contents of `run.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Description {
    id: String,
    /// Process id of the supervisor.
    owner: u32,
    settings: RunSettings,
}

impl Run {
    /// Makes the directory of a new run that the calling process owns.
    ///
    /// # Errors
    /// [`RunError::SharedMemoryFull`], or [`RunError::File`] when the directory cannot be made.
    pub fn create(settings: RunSettings) -> Result<Self, RunError> {
        shared_memory::check_space()?;
        let owner = std::process::id();
        let (id, directory) = unused_directory(&base())?;
        let run = Self { directory, description: Description { id, owner, settings } };
        // A process id comes again: nothing of an earlier run with this name may be found in shared memory.
        shared_memory::wipe(&run.prefix())?;
        for folder in [run.ready_directory(), run.iceoryx2_root()] {
            std::fs::create_dir(&folder).map_err(|error| failed("cannot be made", &folder, error))?;
        }
        run.write_iceoryx2_config()?;
        run.write_json("run.json", &run.description)?;
        Ok(run)
    }

    /// Where the run's topics are, for other iceoryx2 clients: `iox2` reads this file when it is started from the run
    /// directory, programs load it by its name.
    fn write_iceoryx2_config(&self) -> Result<(), RunError> {
        let path = self.directory.join("config/iceoryx2.toml");
        let (root, prefix) = (self.iceoryx2_root(), self.prefix());
        let text = format!("[global]\nroot-path = \"{}\"\nprefix = \"{prefix}\"\n", root.display());
        std::fs::create_dir(self.directory.join("config"))
            .and_then(|()| std::fs::write(&path, text))
            .map_err(|error| failed("cannot be written", &path, error))
    }

    /// Finds the run that lives in `directory`.
    ///
    /// # Errors
    /// [`RunError::File`] or [`RunError::Malformed`] when no run lives there.
    pub fn load(directory: &Path) -> Result<Self, RunError> {
        let description = read_json(&directory.join("run.json"))?;
        Ok(Self { directory: directory.to_owned(), description })
    }

    /// Every run on this machine that has a directory, whether its owner still lives or not.
    pub fn all() -> Vec<Self> {
        let Ok(entries) = std::fs::read_dir(base()) else { return Vec::new() };
        let mut runs: Vec<_> = entries
            .filter_map(Result::ok)
            .filter(|entry| entry.file_name().to_string_lossy().starts_with("coact_"))
            .filter_map(|entry| Self::load(&entry.path()).ok())
            .collect();
        runs.sort_by(|a, b| a.description.id.cmp(&b.description.id));
        runs
    }

    /// True while the process that created the run exists.
    pub fn owner_lives(&self) -> bool {
        let pid = i32::try_from(self.description.owner).ok().and_then(rustix::process::Pid::from_raw);
        pid.is_some_and(|pid| rustix::process::test_kill_process(pid) != Err(rustix::io::Errno::SRCH))
    }

    /// Removes the run's directory and every shared-memory file of its prefix. The report directory stays.
    ///
    /// # Errors
    /// [`RunError::File`] names what could not be removed.
    pub fn remove(&self) -> Result<(), RunError> {
        shared_memory::wipe(&self.prefix())?;
        match std::fs::remove_dir_all(&self.directory) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(failed("cannot be removed", &self.directory, error))
            }
            _ => Ok(()),
        }
    }

    /// The run directory.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// The run's name, unique on this machine.
    pub fn id(&self) -> &str {
        &self.description.id
    }

    /// Process id of the supervisor that owns the run.
    pub fn owner(&self) -> u32 {
        self.description.owner
    }

    /// What the run is made of.
    pub fn settings(&self) -> &RunSettings {
        &self.description.settings
    }

    /// What every shared-memory name of the run begins with.
    pub fn prefix(&self) -> String {
        format!("coact_{}_", self.description.id)
    }

    /// Root directory of the run's iceoryx2 files.
    pub fn iceoryx2_root(&self) -> PathBuf {
        self.directory.join("iox")
    }

    /// Starts the clock: `start_ns` (`CLOCK_MONOTONIC`) is the release of tick 0 for every process, restarted ones
    /// included. The supervisor calls this once, when all processes are ready, with an instant a little ahead.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn start(&self, start_ns: u64) -> Result<(), RunError> {
        self.write_json("start", &start_ns)
    }

    /// Release of tick 0, ns of `CLOCK_MONOTONIC`; `None` until [`Run::start`] was called.
    ///
    /// # Errors
    /// [`RunError::Malformed`] when the file contains no number.
    pub fn start_ns(&self) -> Result<Option<u64>, RunError> {
        let path = self.directory.join("start");
        if path.exists() { read_json(&path).map(Some) } else { Ok(None) }
    }

    /// Reports a process ready.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn report_ready(&self, ready: &Ready) -> Result<(), RunError> {
        self.write_json(&ready_name(&ready.process, ready.generation), ready)
    }

    /// The report of a process start, once it is ready.
    ///
    /// # Errors
    /// [`RunError::Malformed`].
    pub fn ready(&self, process: &str, generation: u32) -> Result<Option<Ready>, RunError> {
        let path = self.directory.join(ready_name(process, generation));
        if path.exists() { read_json(&path).map(Some) } else { Ok(None) }
    }

    fn ready_directory(&self) -> PathBuf {
        self.directory.join("ready")
    }

    /// Writes whole files only: a reader sees the new contents or none.
    fn write_json(&self, name: &str, value: &impl Serialize) -> Result<(), RunError> {
        let path = self.directory.join(name);
        let unfinished = path.with_extension(format!("{}.unfinished", std::process::id()));
        let text = serde_json::to_string_pretty(value)
            .map_err(|error| failed("cannot be written", &path, error.into()))?;
        std::fs::write(&unfinished, text)
            .and_then(|()| std::fs::rename(&unfinished, &path))
            .map_err(|error| failed("cannot be written", &path, error))
    }
}

fn ready_name(process: &str, generation: u32) -> String {
    format!("ready/{process}.{generation}.json")
}

fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, RunError> {
    let text = std::fs::read_to_string(path).map_err(|error| failed("cannot be read", path, error))?;
    serde_json::from_str(&text)
        .map_err(|error| RunError::Malformed { path: path.to_owned(), problem: error.to_string() })
}

fn failed(operation: &'static str, path: &Path, cause: io::Error) -> RunError {
    RunError::File { path: path.to_owned(), operation, cause }
}

/// The folder of all run directories: in memory, because iceoryx2 syncs a dozen files when a process starts, which takes
/// time on a disk. The path is short, too: the names of sockets in it grow to some 80 bytes, and the system takes 108.
fn base() -> PathBuf {
    let memory = Path::new(shared_memory::DIRECTORY);
    if memory.is_dir() { memory.to_owned() } else { std::env::temp_dir() }
}

/// Takes a name that no other run has: the process id and a count, kept by making the directory.
fn unused_directory(base: &Path) -> Result<(String, PathBuf), RunError> {
    for count in 0_u32.. {
        let id = format!("{:x}-{count:x}", std::process::id());
        let directory = base.join(format!("coact_{id}"));
        match std::fs::create_dir(&directory) {
            Ok(()) => return Ok((id, directory)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(failed("cannot be made", &directory, error)),
        }
    }
    Err(failed("has no free name left", base, io::ErrorKind::AlreadyExists.into()))
}
