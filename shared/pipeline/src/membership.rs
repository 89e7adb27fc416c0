use crate::run_lock::is_locked_against;
use rustix::fs::{FlockOperation, flock};
use rustix::io::retry_on_intr;
use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

/// That a process belongs to a run and outlives its supervisor, for as long as this value lives: a shared lock, which the kernel
/// releases however the process ends. A run with a member is no remains, whoever owns it.
#[derive(Debug)]
pub struct Membership {
    /// Locked as long as it is open.
    _file: File,
}

impl Membership {
    /// Makes the file of a new run's directory.
    ///
    /// # Errors
    /// It cannot be made.
    pub(crate) fn prepare(directory: &Path) -> io::Result<()> {
        let path = path_of(directory);
        OpenOptions::new().write(true).create_new(true).mode(0o600).open(path).map(drop)
    }

    /// The calling process is a member of the run in `directory`.
    ///
    /// # Errors
    /// There is no such run, or its file cannot be opened.
    pub(crate) fn begin(directory: &Path) -> io::Result<Self> {
        let file = File::open(path_of(directory))?;
        retry_on_intr(|| flock(&file, FlockOperation::LockShared))?;
        Ok(Self { _file: file })
    }

    /// Whether the run in `directory` has a member.
    pub(crate) fn is_any(directory: &Path) -> bool {
        is_locked_against(&path_of(directory), FlockOperation::NonBlockingLockExclusive)
    }
}

fn path_of(directory: &Path) -> PathBuf {
    directory.join("members")
}
