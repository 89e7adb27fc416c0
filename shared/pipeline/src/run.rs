use crate::run_lock::{Held, RunLock};
use crate::{Membership, MemoryReserve, Owner, Ready, RunError, RunSettings, shared_memory, trust};
use serde::{Deserialize, Serialize};
use std::fs::{DirBuilder, OpenOptions};
use std::io::{self, Write};
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// One run of the process set: its directory, its identity, and the names that keep it apart from other runs.
///
/// ```text
/// /dev/shm/coact_<id>/lock         locked as long as the supervisor lives: who holds it owns the run
///                    /members      locked, shared, by each process that outlives its supervisor: while one does, the run lives
///                    /owner.json   which supervisor owns the run
///                    /run.json     what the run is made of
///                    /start        clock reading of tick 0, written when all are ready
///                    /config/      iceoryx2.toml: where other iceoryx2 clients find the run's topics
///                    /ready/       <name>.<generation>.json, one for each process start
///                           <name>.heartbeat, touched as a sign of life
///                    /iox/         root directory of iceoryx2
/// /dev/shm/coact_<id>_*            the run's shared memory
/// ```
///
/// All of it belongs to one user and is closed to all others, whatever the umask.
#[derive(Debug, Clone)]
pub struct Run {
    directory: PathBuf,
    description: Description,
    /// Held by the process that made or adopted the run, by none that found it.
    lock: Option<Arc<RunLock>>,
}

/// Which supervisor owns the run.
const OWNER: &str = "owner.json";
/// The lock of a run is tried for so long: whoever looks at it holds it for some microseconds. Chosen by hand.
const LOOKED_AT_FOR: Duration = Duration::from_millis(500);
/// How often. Chosen by hand; not sensitive.
const LOOK_EVERY: Duration = Duration::from_millis(5);

impl PartialEq for Run {
    fn eq(&self, other: &Self) -> bool {
        self.directory == other.directory && self.description == other.description
    }
}

impl Eq for Run {}

/// Contents of `run.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Description {
    id: String,
    settings: RunSettings,
}

impl Run {
    /// Makes the directory of a new run that the calling process owns.
    ///
    /// # Errors
    /// [`RunError::SharedMemoryFull`], or [`RunError::File`] when the directory cannot be made.
    pub fn create(settings: RunSettings) -> Result<Self, RunError> {
        shared_memory::check_space()?;
        let (id, directory, lock) = unused_directory(&base())?;
        let description = Description { id, settings };
        let run = Self { directory, description, lock: Some(Arc::new(lock)) };
        // A process id comes again: nothing of an earlier run with this name may be found in shared memory.
        shared_memory::wipe(&run.prefix())?;
        for folder in [run.ready_directory(), run.iceoryx2_root(), run.directory.join("config")] {
            create_directory(&folder).map_err(|error| failed("cannot be made", &folder, error))?;
        }
        run.write_iceoryx2_config()?;
        Membership::prepare(&run.directory)
            .map_err(|error| failed("cannot be prepared", &run.directory, error))?;
        run.write_json(OWNER, &Owner { pid: std::process::id(), generation: 0 })?;
        run.write_json("run.json", &run.description)?;
        Ok(run)
    }

    /// Where the run's topics are, for other iceoryx2 clients: `iox2` reads this file when it is started from the run
    /// directory, programs load it by its name.
    fn write_iceoryx2_config(&self) -> Result<(), RunError> {
        let path = self.directory.join("config/iceoryx2.toml");
        let (root, prefix) = (self.iceoryx2_root(), self.prefix());
        let text = format!("[global]\nroot-path = \"{}\"\nprefix = \"{prefix}\"\n", root.display());
        write_private(&path, &text).map_err(|error| failed("cannot be written", &path, error))
    }

    /// Finds the run that lives in `directory`.
    ///
    /// # Errors
    /// [`RunError::File`] or [`RunError::Malformed`] when no run lives there; [`RunError::Untrusted`] when another user may
    /// have put there what is found.
    pub fn load(directory: &Path) -> Result<Self, RunError> {
        let path = directory.join("run.json");
        // First the directory, into which another user's cannot be looked.
        trust::directory(directory)?;
        trust::file(&path)?;
        let description: Description = read_json(&path)?;
        // The name selects what is removed from shared memory: it must be this run's.
        if directory.file_name() != Some(format!("coact_{}", description.id).as_ref()) {
            let problem = format!("the id {} is not that of the directory", description.id);
            return Err(RunError::Malformed { path, problem });
        }
        Ok(Self { directory: directory.to_owned(), description, lock: None })
    }

    /// The run of this name.
    ///
    /// # Errors
    /// As [`Run::load`].
    pub fn named(id: &str) -> Result<Self, RunError> {
        Self::load(&base().join(format!("coact_{id}")))
    }

    /// Every run of this user on this machine that has a directory, whether its owner still lives or not.
    pub fn all() -> Vec<Self> {
        let mut runs: Vec<_> = directories().filter_map(|directory| Self::load(&directory).ok()).collect();
        runs.sort_by(|a, b| a.description.id.cmp(&b.description.id));
        runs
    }

    /// True while the supervisor lives that made the run, or adopted it last: it holds the run's lock.
    pub fn owner_lives(&self) -> bool {
        self.lock.is_some() || RunLock::is_held(&self.directory)
    }

    /// True when the supervisor has died and processes of the run live on.
    pub fn is_orphaned(&self) -> bool {
        !self.owner_lives() && Membership::is_any(&self.directory)
    }

    /// Waits until the supervisor has died. Who waits uses no time.
    ///
    /// # Errors
    /// [`RunError::File`] when there is no such run any more.
    pub fn wait_for_death_of_owner(&self) -> Result<(), RunError> {
        RunLock::wait_for_release(&self.directory)
            .map_err(|error| failed("cannot be waited for", &self.directory, error))
    }

    /// From now on the calling process is the supervisor of a run whose own has died.
    ///
    /// # Errors
    /// [`RunError::NotOrphaned`] says why it cannot be; [`RunError::File`] or [`RunError::Malformed`].
    pub fn adopt(&self) -> Result<Self, RunError> {
        let refused = |problem| RunError::NotOrphaned { path: self.directory.clone(), problem };
        let Some(lock) = self.take_lock() else { return Err(refused("its supervisor lives")) };
        if !Membership::is_any(&self.directory) {
            return Err(refused("none of its processes lives any more"));
        }
        if self.start_ns()?.is_none() {
            return Err(refused("it had not begun when its supervisor died"));
        }
        // Room for what its successor makes; it reserves its own.
        shared_memory::wipe(&MemoryReserve::name(self))?;
        let run = Self { lock: Some(Arc::new(lock)), ..self.clone() };
        let generation = self.owner()?.generation + 1;
        run.write_json(OWNER, &Owner { pid: std::process::id(), generation })?;
        Ok(run)
    }

    /// The lock of a run whose owner is dead. Others hold it for an instant when they look who owns the run.
    fn take_lock(&self) -> Option<RunLock> {
        let since = Instant::now();
        while since.elapsed() < LOOKED_AT_FOR {
            if let Ok(Held::ByCaller(lock)) = RunLock::look(&self.directory) {
                return Some(lock);
            }
            std::thread::sleep(LOOK_EVERY);
        }
        None
    }

    /// The calling process is a process of the run that outlives its supervisor, for as long as the returned value lives.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn become_member(&self) -> Result<Membership, RunError> {
        Membership::begin(&self.directory).map_err(|error| failed("cannot be joined", &self.directory, error))
    }

    /// Removes the run's directory and every shared-memory file of its prefix. The report directory stays.
    ///
    /// # Errors
    /// [`RunError::File`] names what could not be removed; [`RunError::Owned`] when another living process owns the run, or
    /// belongs to it.
    pub fn remove(&self) -> Result<(), RunError> {
        let _lock = match &self.lock {
            Some(_) => None,
            None => match RunLock::look(&self.directory) {
                Ok(Held::ByCaller(lock)) => Some(lock),
                Err(_) if !self.directory.exists() => None,
                _ => return Err(RunError::Owned { path: self.directory.clone() }),
            },
        };
        if Membership::is_any(&self.directory) {
            return Err(RunError::Owned { path: self.directory.clone() });
        }
        remove_all(&self.directory, &self.prefix())
    }

    /// Removes what runs of this user left behind of which nobody lives: exactly those whose lock can be taken and that have
    /// no member, whatever else is in their directories. Returns what could not be removed.
    pub fn remove_dead() -> Vec<RunError> {
        let is_own = |directory: &PathBuf| directory.is_dir() && trust::is_own(directory).unwrap_or(false);
        directories().filter(is_own).filter_map(|directory| remove_if_dead(&directory).err()).collect()
    }

    /// Closes all of the run's shared memory to other users, whoever made it.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn close_to_others(&self) -> Result<(), RunError> {
        shared_memory::close_to_others(&self.prefix())
    }

    /// The run directory.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// The run's name, unique on this machine.
    pub fn id(&self) -> &str {
        &self.description.id
    }

    /// The supervisor that owns the run, or did when it died: looked up anew each time, for a run may be adopted.
    ///
    /// # Errors
    /// [`RunError::File`] or [`RunError::Malformed`].
    pub fn owner(&self) -> Result<Owner, RunError> {
        read_json(&self.directory.join(OWNER))
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

    /// The newest report of a process: that of its highest generation; `None` while it was never ready.
    ///
    /// # Errors
    /// [`RunError::Malformed`].
    pub fn newest_ready(&self, process: &str) -> Result<Option<Ready>, RunError> {
        let entries = std::fs::read_dir(self.ready_directory()).into_iter().flatten().filter_map(Result::ok);
        let generation = |name: &str| -> Option<u32> {
            name.strip_prefix(process)?.strip_prefix('.')?.strip_suffix(".json")?.parse().ok()
        };
        let newest = entries.filter_map(|entry| generation(entry.file_name().to_str()?)).max();
        newest.map_or(Ok(None), |newest| self.ready(process, newest))
    }

    /// The file that a process without pulses touches as a sign of life.
    pub fn heartbeat_file(&self, process: &str) -> PathBuf {
        self.ready_directory().join(format!("{process}.heartbeat"))
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
        write_private(&unfinished, &text)
            .and_then(|()| std::fs::rename(&unfinished, &path))
            .map_err(|error| failed("cannot be written", &path, error))
    }
}

fn ready_name(process: &str, generation: u32) -> String {
    format!("ready/{process}.{generation}.json")
}

fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, RunError> {
    let text = coact_input_file::read_text(path).map_err(|error| failed("cannot be read", path, error))?;
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

/// Whatever is called like a run's directory.
fn directories() -> impl Iterator<Item = PathBuf> {
    let entries = std::fs::read_dir(base()).into_iter().flatten().filter_map(Result::ok);
    entries.map(|entry| entry.path()).filter(|path| name_of(path).is_some())
}

/// The run's name for itself in shared memory, without the underscore that ends a prefix.
fn name_of(directory: &Path) -> Option<&str> {
    directory.file_name()?.to_str().filter(|name| name.starts_with("coact_"))
}

fn remove_if_dead(directory: &Path) -> Result<(), RunError> {
    match RunLock::look(directory) {
        // Its supervisor has died, its processes have not.
        Ok(Held::ByCaller(_lock)) if Membership::is_any(directory) => Ok(()),
        Ok(Held::ByCaller(_lock)) => match name_of(directory) {
            Some(name) => remove_all(directory, &format!("{name}_")),
            None => Ok(()),
        },
        Ok(Held::ByOwner) => Ok(()),
        // Who made it may have died before there was a lock, and may be about to make one, which then tells it that the
        // directory is gone. Only an empty one is removed: without a lock nothing says that a run has ended.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            std::fs::remove_dir(directory).ok();
            Ok(())
        }
        Err(error) => Err(failed("cannot be locked", directory, error)),
    }
}

fn remove_all(directory: &Path, prefix: &str) -> Result<(), RunError> {
    shared_memory::wipe(prefix)?;
    match std::fs::remove_dir_all(directory) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(failed("cannot be removed", directory, error))
        }
        _ => Ok(()),
    }
}

/// A directory that nobody else can enter, whatever the umask.
fn create_directory(path: &Path) -> io::Result<()> {
    DirBuilder::new().mode(0o700).create(path)
}

/// A file that nobody else can open, whatever the umask.
fn write_private(path: &Path, text: &str) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).create(true).truncate(true).mode(0o600).open(path)?;
    file.write_all(text.as_bytes())
}

/// Takes a name that no other run has: the process id and a count, kept by making the directory.
fn unused_directory(base: &Path) -> Result<(String, PathBuf, RunLock), RunError> {
    for count in 0_u32.. {
        let id = format!("{:x}-{count:x}", std::process::id());
        let directory = base.join(format!("coact_{id}"));
        match create_directory(&directory).and_then(|()| RunLock::create(&directory)) {
            Ok(lock) => return Ok((id, directory, lock)),
            // Taken, or removed as remains while it was made: the next name.
            Err(error) if matches!(error.kind(), io::ErrorKind::AlreadyExists | io::ErrorKind::NotFound) => {}
            Err(error) => return Err(failed("cannot be made", &directory, error)),
        }
    }
    Err(failed("has no free name left", base, io::ErrorKind::AlreadyExists.into()))
}
